#include "GeoTiffTags.h"

#include <tiffio.h>

#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
#include <memory>
#include <sstream>
#include <vector>

namespace pointfront
{
namespace
{
enum Tag : std::uint32_t
{
  PixelScale = 33550,
  TiePoints = 33922,
  Transformation = 34264,
  NoData = 42113
};

struct Close
{
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, Close>;

int keepMessage(TIFF*, void* kept, const char*, const char* format, va_list arguments)
{
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  *static_cast<std::string*>(kept) = text;
  return 1; // handled: libtiff prints nothing
}

int ignoreWarning(TIFF*, void*, const char*, const char*, va_list)
{
  return 1; // unknown tags, mostly the very ones that are wanted here
}

Tiff openTiff(const std::string& path, std::string& message)
{
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, &keepMessage, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options, &ignoreWarning, nullptr);
  Tiff tiff(TIFFOpenExt(path.c_str(), "rm", options)); // m: no memory map
  TIFFOpenOptionsFree(options);
  return tiff;
}

/// The elements of a tag, as libtiff hands on those that it has no name for: type and count are
/// the file's. Empty when absent, or of another type.
template <typename T>
std::vector<T> elements(TIFF* tiff, std::uint32_t tag, TIFFDataType type)
{
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (field == nullptr || TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0)
  {
    return {};
  }
  const void* data = nullptr;
  std::uint32_t count = 0;
  std::uint16_t shortCount = 0;
  const bool wide = TIFFFieldReadCount(field) == TIFF_VARIABLE2;
  const int found =
    wide ? TIFFGetField(tiff, tag, &count, &data) : TIFFGetField(tiff, tag, &shortCount, &data);
  count = wide ? count : shortCount;
  if (found == 0 || data == nullptr)
  {
    return {};
  }
  std::vector<T> values(count);
  std::memcpy(values.data(), data, count * sizeof(T));
  return values;
}

std::string text(TIFF* tiff, std::uint32_t tag)
{
  const std::vector<char> characters = elements<char>(tiff, tag, TIFF_ASCII);
  return { characters.begin(), characters.end() };
}

std::optional<double> number(const std::string& text)
{
  std::istringstream stream(text.c_str()); // up to its end mark
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (stream >> value)
  {
    return value;
  }
  return text.compare(0, 3, "nan") == 0 ? std::optional<double>(std::nan("")) : std::nullopt;
}

/// `corner`: the ground of raster position (0, 0), which is a corner or a centre.
std::optional<GeoTransform> place(
  bool centre, const glm::dvec2& origin, const glm::dvec2& u, const glm::dvec2& v)
{
  return centre ? GeoTransform::fromCentre(origin, u, v) : GeoTransform::fromCorner(origin, u, v);
}

Result<std::optional<GeoTransform>> transformOf(
  TIFF* tiff, const std::string& path, bool pixelIsPoint)
{
  std::optional<GeoTransform> transform;
  const auto scale = elements<double>(tiff, PixelScale, TIFF_DOUBLE);
  const auto tie = elements<double>(tiff, TiePoints, TIFF_DOUBLE);
  const auto matrix = elements<double>(tiff, Transformation, TIFF_DOUBLE);
  if (matrix.size() >= 16) // row by row: x = m0 column + m1 row + m3, y = m4 column + m5 row + m7
  {
    transform = place(
      pixelIsPoint, { matrix[3], matrix[7] }, { matrix[0], matrix[4] }, { matrix[1], matrix[5] });
  }
  else if (scale.size() >= 2 && tie.size() >= 6)
  {
    const glm::dvec2 u(scale[0], 0.0);
    const glm::dvec2 v(0.0, -std::abs(scale[1]));
    const glm::dvec2 origin(tie[3] - tie[0] * u.x, tie[4] - tie[1] * v.y);
    transform = place(pixelIsPoint, origin, u, v);
  }
  else if (tie.size() >= 12)
  {
    return makeError(Error::Kind::Unsupported,
      path +
        ": this GeoTIFF is tied to the ground by control points only; rectify it first "
        "(gdalwarp does)");
  }
  else
  {
    return transform;
  }
  if (!transform)
  {
    return makeError(
      Error::Kind::BadFormat, path + ": the pixels that its GeoTIFF tags describe have no area");
  }
  return transform;
}
/// Strips or tiles of the first image that end behind the end of the file. Those without bytes are
/// sparse: no data, on purpose.
Result<void> checkPixelsAreThere(TIFF* tiff, const std::string& path)
{
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(path, failure);
  const std::uint64_t* offsets = nullptr;
  const std::uint64_t* lengths = nullptr;
  const bool tiled = TIFFIsTiled(tiff) != 0;
  TIFFGetField(tiff, tiled ? TIFFTAG_TILEOFFSETS : TIFFTAG_STRIPOFFSETS, &offsets);
  TIFFGetField(tiff, tiled ? TIFFTAG_TILEBYTECOUNTS : TIFFTAG_STRIPBYTECOUNTS, &lengths);
  const std::uint32_t count = tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  std::uint32_t lost = offsets == nullptr || lengths == nullptr ? count : 0;
  for (std::uint32_t i = 0; lost != count && i < count; ++i)
  {
    lost += offsets[i] > size || lengths[i] > size - offsets[i] ? 1 : 0;
  }
  if (lost > 0)
  {
    return makeError(Error::Kind::Truncated,
      path + ": " + std::to_string(lost) + " of " + std::to_string(count) +
        (tiled ? " tiles" : " strips") + " of pixels end behind byte " + std::to_string(size) +
        ", the end of the file; get a whole copy");
  }
  return {};
}

/// As OpenImageIO reduces them to 8 bits.
std::vector<std::array<std::uint8_t, 3>> coloursOf(TIFF* tiff)
{
  std::uint16_t bits = 1;
  const std::uint16_t* channels[3] = {};
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  std::vector<std::array<std::uint8_t, 3>> colours;
  if (TIFFGetField(tiff, TIFFTAG_COLORMAP, &channels[0], &channels[1], &channels[2]) == 0)
  {
    return colours;
  }
  for (std::size_t i = 0; i < (std::size_t(1) << bits); ++i)
  {
    const auto byte = [&](int c) { return static_cast<std::uint8_t>(channels[c][i] / 257); };
    colours.push_back({ byte(0), byte(1), byte(2) });
  }
  return colours;
}
} // namespace

bool GeoTiffTags::isTiff(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  char head[4] = {};
  file.read(head, sizeof head);
  const std::string start(head, sizeof head);
  return start == std::string("II*\0", 4) || start == std::string("MM\0*", 4) ||
    start == std::string("II+\0", 4) || start == std::string("MM\0+", 4);
}

Result<GeoTiffTags> GeoTiffTags::read(const std::string& path)
{
  std::string message;
  const Tiff tiff = openTiff(path, message);
  if (!tiff)
  {
    return makeError(Error::Kind::BadFormat,
      path + ": its TIFF directory cannot be read" + (message.empty() ? "" : ": " + message));
  }
  if (Result<void> there = checkPixelsAreThere(tiff.get(), path); !there)
  {
    return there.error();
  }
  GeoTiffTags tags;
  tags.keys = GeoKeys::parse(elements<std::uint16_t>(tiff.get(), GeoKeys::directoryTag, TIFF_SHORT),
    text(tiff.get(), GeoKeys::textTag));
  Result<std::optional<GeoTransform>> transform =
    transformOf(tiff.get(), path, tags.keys.pixelIsPoint());
  if (!transform)
  {
    return transform.error();
  }
  tags.transform = *transform;
  tags.noData = number(text(tiff.get(), NoData));
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff.get(), TIFFTAG_PHOTOMETRIC, &photometric);
  tags.palette = photometric == PHOTOMETRIC_PALETTE;
  tags.whiteIsZero = photometric == PHOTOMETRIC_MINISWHITE;
  if (tags.palette)
  {
    tags.colours = coloursOf(tiff.get());
  }
  return tags;
}

} // namespace pointfront
