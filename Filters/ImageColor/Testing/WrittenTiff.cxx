#include "WrittenTiff.h"

#include <gtest/gtest.h>

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pointfront::test
{
namespace
{
const TIFFFieldInfo geoFields[] = { { 33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1,
                                      const_cast<char*>("PixelScale") },
  { 33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("TiePoints") },
  { 34264, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("Transformation") },
  { 34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeys") },
  { 42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("NoData") } };

template <typename T>
void put(std::vector<std::uint8_t>& bytes, double value)
{
  const T element = static_cast<T>(value);
  const auto* first = reinterpret_cast<const std::uint8_t*>(&element);
  bytes.insert(bytes.end(), first, first + sizeof element);
}

void putElement(std::vector<std::uint8_t>& bytes, int bits, int format, double value)
{
  switch (format * 100 + bits)
  {
    case 108:
      return put<std::uint8_t>(bytes, value);
    case 116:
      return put<std::uint16_t>(bytes, value);
    case 132:
      return put<std::uint32_t>(bytes, value);
    case 208:
      return put<std::int8_t>(bytes, value);
    case 216:
      return put<std::int16_t>(bytes, value);
    case 232:
      return put<std::int32_t>(bytes, value);
    case 332:
      return put<float>(bytes, value);
    case 364:
      return put<double>(bytes, value);
    default:
      ADD_FAILURE() << "no such type: " << bits << " bits of format " << format;
  }
}

/// Elements of less than 8 bits, the first in the upper bits; a row begins with a byte.
std::vector<std::uint8_t> packedRows(const WrittenTiff& image)
{
  const int across = image.width * image.channels;
  const int rowBytes = (across * image.bits + 7) / 8;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(rowBytes * image.height));
  for (int i = 0; i < across * image.height; ++i)
  {
    const int bit = i % across * image.bits;
    const auto value = static_cast<unsigned>(image.values[static_cast<std::size_t>(i)]);
    std::uint8_t& byte = bytes[static_cast<std::size_t>(i / across * rowBytes + bit / 8)];
    byte = static_cast<std::uint8_t>(byte | value << (8 - image.bits - bit % 8));
  }
  return bytes;
}

/// The same in one tile, with zeros on the right and below.
std::vector<std::uint8_t> packedTile(const WrittenTiff& image)
{
  EXPECT_TRUE(image.channels == 1 && image.width <= image.tile && image.height <= image.tile);
  WrittenTiff whole = image;
  whole.width = whole.height = image.tile;
  whole.values.assign(static_cast<std::size_t>(image.tile * image.tile), 0.0);
  for (int y = 0; y < image.height; ++y)
  {
    std::copy_n(
      image.values.begin() + y * image.width, image.width, whole.values.begin() + y * image.tile);
  }
  return packedRows(whole);
}

void setGeoTags(TIFF* tiff, const WrittenTiff& image)
{
  TIFFMergeFieldInfo(tiff, geoFields, 5);
  const auto set = [&](std::uint32_t tag, const auto& values)
  {
    if (!values.empty())
    {
      TIFFSetField(tiff, tag, static_cast<int>(values.size()), values.data());
    }
  };
  set(33550, image.scale);
  set(33922, image.tie);
  set(34264, image.matrix);
  set(34735, image.keys);
  if (!image.noData.empty())
  {
    TIFFSetField(tiff, 42113, image.noData.c_str());
  }
}

void setLayout(TIFF* tiff, const WrittenTiff& image)
{
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, image.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, image.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, image.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, image.channels);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, image.sampleFormat);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
    image.palette           ? PHOTOMETRIC_PALETTE
      : image.whiteIsZero   ? PHOTOMETRIC_MINISWHITE
      : image.channels >= 3 ? PHOTOMETRIC_RGB
                            : PHOTOMETRIC_MINISBLACK);
  if (image.alpha)
  {
    const std::uint16_t extra = EXTRASAMPLE_UNASSALPHA;
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &extra);
  }
  if (image.palette)
  {
    std::array<std::vector<std::uint16_t>, 3> colours;
    for (int i = 0; i < 256; ++i)
    {
      colours[0].push_back(static_cast<std::uint16_t>((255 - i) * 257));
      colours[1].push_back(static_cast<std::uint16_t>(i * 257));
      colours[2].push_back(7 * 257);
    }
    TIFFSetField(tiff, TIFFTAG_COLORMAP, colours[0].data(), colours[1].data(), colours[2].data());
  }
}

void writeTiles(TIFF* tiff, const WrittenTiff& image, const std::vector<std::uint8_t>& bytes)
{
  const std::size_t pixel = static_cast<std::size_t>(image.channels * image.bits / 8);
  const int side = image.tile;
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, side);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, side);
  std::vector<std::uint8_t> tile(static_cast<std::size_t>(side * side) * pixel);
  for (int y = 0; y < image.height; y += side)
  {
    for (int x = 0; x < image.width; x += side)
    {
      for (int row = y; row < std::min(y + side, image.height); ++row)
      {
        const int count = std::min(side, image.width - x);
        std::memcpy(tile.data() + static_cast<std::size_t>((row - y) * side) * pixel,
          bytes.data() + static_cast<std::size_t>(row * image.width + x) * pixel,
          static_cast<std::size_t>(count) * pixel);
      }
      TIFFWriteTile(
        tiff, tile.data(), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0);
    }
  }
}
} // namespace

std::string WrittenTiff::write(const std::string& name) const
{
  const std::string path = testing::TempDir() + name;
  TIFF* tiff = TIFFOpen(path.c_str(), "w");
  EXPECT_NE(tiff, nullptr) << path;
  if (tiff == nullptr)
  {
    return path;
  }
  EXPECT_EQ(values.size(), static_cast<std::size_t>(width * height * channels));
  setLayout(tiff, *this);
  setGeoTags(tiff, *this);
  std::vector<std::uint8_t> bytes = bits < 8 ? packedRows(*this) : std::vector<std::uint8_t>();
  for (std::size_t i = 0; bits >= 8 && i < values.size(); ++i)
  {
    putElement(bytes, bits, sampleFormat, values[i]);
  }
  if (tile > 0 && bits < 8)
  {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, tile);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, tile);
    TIFFWriteTile(tiff, packedTile(*this).data(), 0, 0, 0, 0);
  }
  else if (tile > 0)
  {
    writeTiles(tiff, *this, bytes);
  }
  else
  {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, stripRows);
    const std::size_t row = bytes.size() / static_cast<std::size_t>(height);
    for (int y = 0; y < height; ++y)
    {
      TIFFWriteScanline(
        tiff, bytes.data() + static_cast<std::size_t>(y) * row, static_cast<std::uint32_t>(y), 0);
    }
  }
  TIFFClose(tiff);
  return path;
}

} // namespace pointfront::test
