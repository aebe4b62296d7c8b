#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/PlanarGeometry.h"
#include "pointfront/Query/Region.h"

#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace pointfront
{

/// All places within a distance of some polylines on the map, at any height or between two heights:
/// a road, a power line. The ends are round.
class LineCorridor final : public Region
{
public:
  /// A line of one vertex is a disc.
  /// BadArgument: a line without vertices; a vertex or the distance is not finite, the distance
  /// is negative, a height is NaN.
  static Result<std::shared_ptr<const LineCorridor>> make(const std::vector<PlanarLine>& lines,
    double distance,
    const std::array<double, 2>& heights = {
      -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() });

  bool contains(const glm::dvec3& point) const override;
  Overlap overlap(const Bounds& box) const override;
  Bounds bounds() const override { return bounds_; }
  void keepInside(const Bounds& box, const glm::dvec3* points, std::size_t count,
    std::uint8_t* keep) const override;

private:
  struct Segment
  {
    glm::dvec2 from;
    glm::dvec2 along; ///< to its other end
    double squaredDistance(const glm::dvec2& p) const;
  };

  LineCorridor() = default;
  /// Overlap of the segment with a rectangle of that centre and half diagonal; safe from rounding.
  Overlap overlapSegment(
    const Segment& segment, const glm::dvec2& centre, double halfDiagonal) const;

  std::vector<Segment> segments_;
  double distance_ = 0.0;
  std::array<double, 2> heights_{};
  Bounds bounds_;
};

} // namespace pointfront
