#pragma once

#include "GeoTransform.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Reference/GeoKeys.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The place of a TIFF on the ground, by tags that OpenImageIO does not hand on.
/// Source   OGC GeoTIFF 1.1, sections 7.1 to 7.3; GDAL's tag 42113 for pixels without data.
struct GeoTiffTags
{
  std::optional<GeoTransform> transform; ///< nothing: the file has no georeference
  GeoKeys keys;
  std::optional<double> noData;
  bool palette = false; ///< pixels are indices into a table of colours
  /// That table: red, green and blue of each index. Empty where there is none.
  std::vector<std::array<std::uint8_t, 3>> colours;
  bool whiteIsZero = false; ///< grey whose 0 is white

  /// True if the file begins as a TIFF or BigTIFF does.
  static bool isTiff(const std::string& path);
  /// The first image of the file.
  /// Errors   Truncated: pixels that would lie behind the end of the file, which image libraries
  ///          take for black. BadFormat: no readable directory, or pixels without an area.
  ///          Unsupported: only control points, which no affine transformation goes through.
  static Result<GeoTiffTags> read(const std::string& path);
};

} // namespace pointfront
