#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Reference/GeoKeys.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Limit for a file that defines a coordinate reference system.
constexpr std::uint64_t mostDefinitionBytes = 1 << 20;

/// A coordinate reference system (CRS) as far as the kernel cares. Coordinates are always x, y, z
/// = easting or longitude, northing or latitude, height, whatever order of axes the system's
/// definition names (LAS 1.4 R15, 2.5; GDAL's "traditional GIS order").
struct CoordinateSystem
{
  std::string wkt; ///< WKT 1 where it can say all of it (LAS 1.4 asks for it), else WKT 2
  std::string name; ///< for messages: "WGS 84 / UTM zone 32N (EPSG:32632)"
  bool geographic = false; ///< x and y are angles; else lengths
  bool geocentric = false; ///< x, y and z count from the middle of the Earth
  bool vertical = false; ///< heights have a system of their own: compound or with three axes
  double unitLength = 1.0; ///< metres a unit of x and y; geographic: radians a unit
  double heightUnit = 1.0; ///< metres a unit of z, if `vertical`
};

/// From one CRS to another.
/// Threads   apply() is thread-safe.
class CoordinateTransform
{
public:
  virtual ~CoordinateTransform() = default;
  /// In place. A point outside of where the transformation is defined becomes infinite: the build
  /// rejects such points and counts them.
  /// Errors  BadArgument, with the reason, when that happens to every finite point of several.
  virtual Result<void> apply(glm::dvec3* points, std::size_t count) const = 0;
  /// Facts that a user should know: a better transformation that lacks its grid file, an
  /// approximate transformation. Full sentences.
  virtual const std::vector<std::string>& warnings() const = 0;
};

/// The known coordinate reference systems. The kernel defines this interface; a module implements
/// it (Filters/Projection).
/// Threads   all methods are thread-safe.
class CoordinateSystems
{
public:
  virtual ~CoordinateSystems() = default;
  /// A code ("EPSG:32632", "EPSG:32632+5773") or a definition (WKT 1 or 2, PROJJSON, PROJ string).
  virtual Result<CoordinateSystem> parse(const std::string& definition) const = 0;
  /// The system that GeoTIFF keys name; user-defined ones are Unsupported. Adds to `warnings`.
  virtual Result<CoordinateSystem> fromGeoKeys(
    const GeoKeys& keys, std::vector<std::string>& warnings) const = 0;
  /// The same coordinates mean the same place: names, order of axes and codes do not count.
  /// horizontally: heights do not count either.
  virtual bool equivalent(
    const CoordinateSystem& a, const CoordinateSystem& b, bool horizontally) const = 0;
  /// Both with heights: all three coordinates are transformed. Else heights stay as they are.
  /// `where`: the points' extent in `from`, empty if not known; the choice among several
  /// transformations is made for it.
  virtual Result<std::unique_ptr<CoordinateTransform>> transform(
    const CoordinateSystem& from, const CoordinateSystem& to, const Bounds& where) const = 0;
};

} // namespace pointfront
