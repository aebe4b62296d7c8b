#include "PNGReader.h"
#include "PNGWriter.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <vector>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;

class PNGWriterTest : public testing::Test
{
protected:
  PNGWriterTest()
    : folder_(fs::path(testing::TempDir()) /
        (std::string("PNGWriter.") + testing::UnitTest::GetInstance()->current_test_info()->name()))
  {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::size_t files() const
  {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

/// Bytes without a pattern that a compressor would find.
std::vector<std::uint8_t> noise(std::size_t count)
{
  std::vector<std::uint8_t> bytes(count);
  std::uint64_t state = 7;
  for (std::uint8_t& byte : bytes)
  {
    state = state * 6364136223846793005u + 1442695040888963407u;
    byte = std::uint8_t(state >> 56);
  }
  return bytes;
}

std::string contentOf(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Sets the largest file that this process may write: what a full disk is, without filling one.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

private:
  rlimit before_ = {};
  void (*handler_)(int) = SIG_DFL;
};

TEST_F(PNGWriterTest, WritesWhatTheReaderReads)
{
  const std::uint32_t width = 67;
  const std::uint32_t height = 41;
  const std::vector<std::uint8_t> rgba = noise(4 * width * height);
  auto writer = PNGWriter::create(path("a.png"), { width, height }, PNGWriter::Pixels::RGBA8);
  ASSERT_TRUE(writer) << writer.error().what;
  ASSERT_TRUE((*writer)->append(rgba.data(), height, 4 * width));
  ASSERT_TRUE((*writer)->finish());

  const Result<Picture> read = readPNG(path("a.png"));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->width, width);
  EXPECT_EQ(read->height, height);
  EXPECT_EQ(read->rgba, rgba);
}

TEST_F(PNGWriterTest, ColoursWithoutOpacityAreOpaque)
{
  const std::vector<std::uint8_t> rgb = noise(3 * 5 * 4);
  auto writer = PNGWriter::create(path("a.png"), { 5, 4 }, PNGWriter::Pixels::RGB8);
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->append(rgb.data(), 4, 15));
  ASSERT_TRUE((*writer)->finish());
  const Result<Picture> read = readPNG(path("a.png"));
  ASSERT_TRUE(read);
  for (std::size_t pixel = 0; pixel < 20; ++pixel)
  {
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      EXPECT_EQ(read->rgba[4 * pixel + channel], rgb[3 * pixel + channel]);
    }
    EXPECT_EQ(read->rgba[4 * pixel + 3], 255);
  }
}

TEST_F(PNGWriterTest, BandsAndBottomUpRowsMakeTheSameFile)
{
  const std::uint32_t width = 50;
  const std::uint32_t height = 30;
  const std::size_t stride = 3 * width;
  const std::vector<std::uint8_t> rows = noise(stride * height);
  std::vector<std::uint8_t> flipped;
  for (std::uint32_t row = height; row-- > 0;)
  {
    flipped.insert(
      flipped.end(), rows.begin() + long(stride * row), rows.begin() + long(stride * (row + 1)));
  }
  const PNGWriter::Size size = { width, height };

  auto whole = PNGWriter::create(path("whole.png"), size, PNGWriter::Pixels::RGB8);
  ASSERT_TRUE(whole);
  ASSERT_TRUE((*whole)->append(rows.data(), height, std::ptrdiff_t(stride)));
  ASSERT_TRUE((*whole)->finish());

  auto banded = PNGWriter::create(path("banded.png"), size, PNGWriter::Pixels::RGB8);
  ASSERT_TRUE(banded);
  for (std::uint32_t row = 0; row < height; row += 7)
  {
    const std::uint32_t count = row + 7 < height ? 7 : height - row;
    ASSERT_TRUE((*banded)->append(rows.data() + stride * row, count, std::ptrdiff_t(stride)));
  }
  ASSERT_TRUE((*banded)->finish());

  auto upwards = PNGWriter::create(path("upwards.png"), size, PNGWriter::Pixels::RGB8);
  ASSERT_TRUE(upwards);
  ASSERT_TRUE(
    (*upwards)->append(flipped.data() + stride * (height - 1), height, -std::ptrdiff_t(stride)));
  ASSERT_TRUE((*upwards)->finish());

  EXPECT_EQ(contentOf(path("whole.png")), contentOf(path("banded.png")));
  EXPECT_EQ(contentOf(path("whole.png")), contentOf(path("upwards.png")));
}

TEST_F(PNGWriterTest, LeavesNothingWhenItIsNotFinished)
{
  {
    const std::vector<std::uint8_t> row(3 * 10);
    auto writer = PNGWriter::create(path("a.png"), { 10, 2 }, PNGWriter::Pixels::RGB8);
    ASSERT_TRUE(writer);
    ASSERT_TRUE((*writer)->append(row.data(), 1, 30));
    EXPECT_FALSE(fs::exists(path("a.png")));
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(PNGWriterTest, AFullDiskIsAnErrorAndLeavesThePictureThatWasThere)
{
  std::ofstream(path("a.png")) << "before";
  const std::uint32_t side = 400;
  const std::vector<std::uint8_t> pixels = noise(4 * side * side); // 640 kB, compressed too
  {
    const FileSizeLimit limit(100000);
    auto writer = PNGWriter::create(path("a.png"), { side, side }, PNGWriter::Pixels::RGBA8);
    ASSERT_TRUE(writer);
    const Result<void> done = (*writer)->append(pixels.data(), side, 4 * side);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, Error::Kind::Unwritable);
    EXPECT_NE(done.error().what.find("a.png"), std::string::npos) << done.error().what;
    EXPECT_NE(done.error().what.find("free some space"), std::string::npos) << done.error().what;
  }
  EXPECT_EQ(contentOf(path("a.png")), "before");
  EXPECT_EQ(files(), 1u);
}

TEST_F(PNGWriterTest, AFullDiskAtTheVeryEndIsAnError)
{
  const std::vector<std::uint8_t> pixels = noise(4 * 16);
  const auto drawn = [&](const char* name)
  {
    auto writer = PNGWriter::create(path(name), { 4, 4 }, PNGWriter::Pixels::RGBA8);
    EXPECT_TRUE(writer);
    EXPECT_TRUE((*writer)->append(pixels.data(), 4, 16));
    return std::move(*writer);
  };
  ASSERT_TRUE(drawn("whole.png")->finish());
  {
    const FileSizeLimit limit(fs::file_size(path("whole.png")) - 1);
    const Result<void> done = drawn("a.png")->finish();
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, Error::Kind::Unwritable);
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(PNGWriterTest, SaysWhyItCannotBegin)
{
  const auto missing = PNGWriter::create(path("none/a.png"), { 4, 4 }, PNGWriter::Pixels::RGBA8);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(missing.error().what.find("does not exist"), std::string::npos);
  EXPECT_FALSE(PNGWriter::create(folder_.string(), { 4, 4 }, PNGWriter::Pixels::RGBA8));
  EXPECT_EQ(files(), 0u);
}

TEST_F(PNGWriterTest, WritesAPictureOfWideRows)
{
  const std::uint32_t width = 1500000; // beyond the limit that libpng sets by itself
  const std::vector<std::uint8_t> row(3 * width, 200);
  auto writer = PNGWriter::create(path("wide.png"), { width, 2 }, PNGWriter::Pixels::RGB8);
  ASSERT_TRUE(writer) << writer.error().what;
  ASSERT_TRUE((*writer)->append(row.data(), 2, 0)); // the same row twice
  ASSERT_TRUE((*writer)->finish());
  const Result<Picture> read = readPNG(path("wide.png"));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->width, width);
  EXPECT_EQ(read->pixel(width - 1, 1)[2], 200);
}
} // namespace
} // namespace pointfront::test
