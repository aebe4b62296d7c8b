#pragma once

#include "GeoTransform.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/ScalarType.h"
#include "pointfront/Reference/CoordinateSystems.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The use of an image's pixels.
enum class RasterUse
{
  Colour, ///< palettes are looked up; 8 or 16 bits a channel, grey or red, green, blue
  Values ///< as they stand in the file: palettes give their index, every type is kept
};

/// A georeferenced image, before any pixel is read.
/// Place     GeoTIFF tags; else a world file beside it.
/// System    GeoTIFF keys; else a .prj file beside it; else not known.
/// No data   pixels of which all channels have GDAL's NODATA value, are NaN, or have alpha 0.
struct RasterFile
{
  std::string path;
  RasterUse use = RasterUse::Colour;
  int width = 0;
  int height = 0;
  int channels = 1; ///< in a pixel as it is read, alpha included
  int alphaChannel = -1; ///< -1: none
  ScalarType type = ScalarType::UInt8; ///< type of one channel
  bool tiff = false;
  bool palette = false; ///< a TIFF with a table of colours
  bool whiteIsZero = false; ///< grey as it stands in the file, to be inverted for colours
  int spreadBits = 0; ///< bits of the file's elements, which are spread over `type`; 0: all it has
  bool spreadInverted = false; ///< and inverted, because 0 is white
  /// Pixels are indices into this table, so that the one without data can be told from others of
  /// its colour. Empty: they are not.
  std::vector<std::array<std::uint8_t, 3>> colours;
  GeoTransform transform;
  std::optional<CoordinateSystem> system;
  std::string systemDoubt; ///< why `system` is not known, or what is odd about it; "" if neither
  std::optional<double> noData;

  int dataChannels() const { return channels - (alphaChannel >= 0 ? 1 : 0); }
  bool hasWideColours() const { return type == ScalarType::UInt16 && colours.empty(); }
  std::size_t pixelBytes() const { return sizeOf(type) * static_cast<std::size_t>(channels); }
  Bounds ground() const; ///< the box of all pixels; z is 0

  /// Errors  NotFound, BadFormat, Truncated; Unsupported: no georeference, a type of pixel that is
  ///         not read.
  static Result<RasterFile> open(
    const std::string& path, RasterUse use, const CoordinateSystems& systems);
};

} // namespace pointfront
