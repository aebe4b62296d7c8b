#pragma once

#include "ProjObject.h"

#include "pointfront/Reference/CoordinateSystems.h"

#include <mutex>

namespace pointfront
{

/// Coordinate reference systems as PROJ and its EPSG database know them.
class ProjCoordinateSystems final : public CoordinateSystems
{
public:
  Result<CoordinateSystem> parse(const std::string& definition) const override;
  Result<CoordinateSystem> fromGeoKeys(
    const GeoKeys& keys, std::vector<std::string>& warnings) const override;
  bool equivalent(
    const CoordinateSystem& a, const CoordinateSystem& b, bool horizontally) const override;
  Result<std::unique_ptr<CoordinateTransform>> transform(
    const CoordinateSystem& from, const CoordinateSystem& to, const Bounds& where) const override;

  /// The horizontal axes of one with the heights of another.
  Result<CoordinateSystem> compound(
    const CoordinateSystem& horizontal, const CoordinateSystem& heights) const;
  /// The UTM zone that `where` of `system` lies in, on that system's own datum: no datum shift.
  /// Zones 32V and 31X to 37X as widened off Norway and Svalbard.
  Result<CoordinateSystem> utmZone(const CoordinateSystem& system, const glm::dvec3& where) const;

private:
  Result<CoordinateSystem> described(const PJconsts* crs) const; // locked by the caller
  Result<CoordinateSystem> withUnit(
    CoordinateSystem system, const GeoKeys& keys, std::vector<std::string>& warnings) const;
  Result<CoordinateSystem> withHeights(
    CoordinateSystem system, const GeoKeys& keys, std::vector<std::string>& warnings) const;

  mutable std::mutex mutex_;
  ProjContext context_; ///< under the mutex
};

} // namespace pointfront
