#include "PNGReader.h"
#include "PNGWriter.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <png.h>
#include <sstream>
#include <vector>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;
using Pixel = std::array<int, 4>;

/// A file as libpng writes it, of the kinds that our own writer does not make.
struct ForeignPNG
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 8;
  int colourType = PNG_COLOR_TYPE_RGB;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<png_color> palette;
  std::vector<png_byte> paletteOpacity;
  std::vector<std::vector<png_byte>> rows;

  void write(const std::string& path) const
  {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, width, height, bits, colourType, interlace, PNG_COMPRESSION_TYPE_BASE,
      PNG_FILTER_TYPE_BASE);
    if (!palette.empty())
    {
      png_set_PLTE(png, info, palette.data(), int(palette.size()));
    }
    if (!paletteOpacity.empty())
    {
      png_set_tRNS(png, info, paletteOpacity.data(), int(paletteOpacity.size()), nullptr);
    }
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; ++pass)
    {
      for (const std::vector<png_byte>& row : rows)
      {
        png_write_row(png, row.data());
      }
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
  }
};

class PNGReaderTest : public testing::Test
{
protected:
  PNGReaderTest()
    : folder_(fs::path(testing::TempDir()) /
        (std::string("PNGReader.") + testing::UnitTest::GetInstance()->current_test_info()->name()))
  {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = (folder_ / "a.png").string();
  }

  std::vector<Pixel> pixels(const ForeignPNG& file) const
  {
    file.write(path_);
    const Result<Picture> read = readPNG(path_);
    EXPECT_TRUE(read) << read.error().what;
    std::vector<Pixel> all;
    for (std::uint32_t row = 0; row < read->height; ++row)
    {
      for (std::uint32_t column = 0; column < read->width; ++column)
      {
        const std::uint8_t* p = read->pixel(column, row);
        all.push_back({ p[0], p[1], p[2], p[3] });
      }
    }
    return all;
  }

  /// A picture of our own whose bytes the compressor cannot shrink much.
  std::string soundFile(std::uint32_t side) const
  {
    std::vector<std::uint8_t> bytes(std::size_t(3) * side * side);
    std::uint64_t state = 3;
    for (std::uint8_t& byte : bytes)
    {
      state = state * 6364136223846793005u + 1442695040888963407u;
      byte = std::uint8_t(state >> 56);
    }
    auto writer = PNGWriter::create(path_, { side, side }, PNGWriter::Pixels::RGB8);
    EXPECT_TRUE((*writer)->append(bytes.data(), side, 3 * std::ptrdiff_t(side)));
    EXPECT_TRUE((*writer)->finish());
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }

  Result<Picture> readBytes(const std::string& bytes) const
  {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
    return readPNG(path_);
  }

  fs::path folder_;
  std::string path_;
};

TEST_F(PNGReaderTest, ReadsGreyOfOneBitAndOf16)
{
  ForeignPNG file;
  file.width = 3;
  file.height = 1;
  file.colourType = PNG_COLOR_TYPE_GRAY;
  file.bits = 1;
  file.rows = { { 0b10100000 } };
  EXPECT_EQ(pixels(file),
    (std::vector<Pixel>{ { 255, 255, 255, 255 }, { 0, 0, 0, 255 }, { 255, 255, 255, 255 } }));
  file.bits = 16;
  // Steps of 257: 0x00ff is 0.99 of one (its high byte alone would be 0), 0x80ff 128.49.
  file.rows = { { 0x00, 0xff, 0x80, 0xff, 0xff, 0xff } };
  EXPECT_EQ(pixels(file),
    (std::vector<Pixel>{ { 1, 1, 1, 255 }, { 128, 128, 128, 255 }, { 255, 255, 255, 255 } }));
}

TEST_F(PNGReaderTest, ReadsPalettesWithOpacity)
{
  ForeignPNG file;
  file.width = 3;
  file.height = 2;
  file.colourType = PNG_COLOR_TYPE_PALETTE;
  file.bits = 2;
  file.palette = { { 10, 20, 30 }, { 200, 100, 50 }, { 1, 2, 3 } };
  file.paletteOpacity = { 255, 77 };
  file.rows = { { 0b00011000 }, { 0b10000100 } };
  EXPECT_EQ(pixels(file),
    (std::vector<Pixel>{ { 10, 20, 30, 255 }, { 200, 100, 50, 77 }, { 1, 2, 3, 255 },
      { 1, 2, 3, 255 }, { 10, 20, 30, 255 }, { 200, 100, 50, 77 } }));
}

TEST_F(PNGReaderTest, ReadsInterlacedColoursAndOpacityOf16Bits)
{
  ForeignPNG file;
  file.width = 9;
  file.height = 10;
  file.colourType = PNG_COLOR_TYPE_RGB_ALPHA;
  file.bits = 16;
  file.interlace = PNG_INTERLACE_ADAM7;
  std::vector<Pixel> expected;
  for (int row = 0; row < 10; ++row)
  {
    std::vector<png_byte> bytes;
    for (int column = 0; column < 9; ++column)
    {
      expected.push_back({ 20 * row, 25 * column, 255 - row, 128 + column });
      for (int value : expected.back())
      {
        bytes.insert(bytes.end(), 2, png_byte(value)); // 257 times the value
      }
    }
    file.rows.push_back(bytes);
  }
  EXPECT_EQ(pixels(file), expected);
}

TEST_F(PNGReaderTest, EveryFileCutShortIsAnErrorThatSaysSo)
{
  const std::string sound = soundFile(12);
  ASSERT_TRUE(readBytes(sound));
  for (std::size_t length = 0; length < sound.size(); ++length)
  {
    const Result<Picture> read = readBytes(sound.substr(0, length));
    ASSERT_FALSE(read) << length;
    EXPECT_EQ(read.error().kind, Error::Kind::Truncated) << length << ": " << read.error().what;
    EXPECT_NE(read.error().what.find("cut short"), std::string::npos) << read.error().what;
  }
}

TEST_F(PNGReaderTest, AChangedByteOfThePixelsIsAnError)
{
  const std::string sound = soundFile(12);
  const std::size_t pixels = 33 + 8; // signature, IHDR, then IDAT's length and name
  for (std::size_t at = pixels; at < pixels + 100; at += 9)
  {
    std::string damaged = sound;
    damaged[at] = char(damaged[at] ^ 0x10);
    const Result<Picture> read = readBytes(damaged);
    ASSERT_FALSE(read) << at;
    EXPECT_EQ(read.error().kind, Error::Kind::BadFormat) << read.error().what;
  }
}

TEST_F(PNGReaderTest, SaysWhatIsNotAPNGFile)
{
  const Result<Picture> text = readBytes("This is a text and not a picture");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().kind, Error::Kind::BadFormat);
  EXPECT_NE(text.error().what.find("not a PNG file"), std::string::npos);
  const Result<Picture> missing = readPNG(path_ + ".none");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, Error::Kind::NotFound);
}

TEST_F(PNGReaderTest, RefusesMorePixelsThanTheLimit)
{
  soundFile(12);
  PNGLimits limits;
  limits.pixels = 143;
  const Result<Picture> read = readPNG(path_, limits);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, Error::Kind::Unsupported);
  EXPECT_NE(read.error().what.find("12 x 12"), std::string::npos) << read.error().what;
  limits.pixels = 144;
  EXPECT_TRUE(readPNG(path_, limits));
}

TEST_F(PNGReaderTest, AShortFileThatClaimsToBeHugeIsRefusedBeforeMemoryIsTaken)
{
  std::string bytes = soundFile(12);
  const auto claim = [&bytes](std::size_t at, std::uint32_t value)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      bytes[at + i] = char(value >> (24 - 8 * i));
    }
  };
  const std::size_t header = 12; // "IHDR", width, height ...; its checksum follows 17 bytes later
  claim(header + 4, 20000);
  claim(header + 8, 20000);
  // The checksum of the new header: CRC-32 as the PNG standard defines it.
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = header; i < header + 17; ++i)
  {
    crc ^= std::uint8_t(bytes[i]);
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
  }
  claim(header + 17, ~crc);
  const Result<Picture> read = readBytes(bytes);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, Error::Kind::Truncated);
  EXPECT_NE(read.error().what.find("too early for 20000 x 20000"), std::string::npos)
    << read.error().what;
}
} // namespace
} // namespace pointfront::test
