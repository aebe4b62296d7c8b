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

/// Upright prisms over polygons: the union of all of them, between two heights.
/// Inside     by the even-odd rule over the rings of one polygon: holes are out; rings may touch
///            or cross themselves. What lies on an edge or vertex, of a hole too, is in.
/// Exactness  by the sign of exact determinants (Orientation.h): two polygons that share an edge
///            leave no point out between them.
/// Cost       a point: some ns for each edge that its node's box meets or has on its right.
class PolygonPrism final : public Region
{
public:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  /// Coordinates beyond this are no places, and their products would overflow.
  static constexpr double farthest = 1e100;

  /// Without polygons, or with heights[0] > heights[1], it contains nothing.
  /// BadArgument: a ring of fewer than three vertices; a vertex that is not finite; a height that
  /// is NaN.
  static Result<std::shared_ptr<const PolygonPrism>> make(
    const std::vector<PlanarPolygon>& polygons,
    const std::array<double, 2>& heights = { -unbounded, unbounded });

  bool contains(const glm::dvec3& point) const override;
  Overlap overlap(const Bounds& box) const override;
  Bounds bounds() const override { return bounds_; }
  void keepInside(const Bounds& box, const glm::dvec3* points, std::size_t count,
    std::uint8_t* keep) const override;

private:
  struct Edge
  {
    glm::dvec2 from;
    glm::dvec2 to;
  };
  struct Polygon
  {
    std::vector<Edge> edges;
    glm::dvec2 low{ unbounded };
    glm::dvec2 high{ -unbounded };
  };

  PolygonPrism() = default;
  static bool insidePolygon(const std::vector<Edge>& edges, const glm::dvec2& p);
  static Overlap overlapPolygon(
    const Polygon& polygon, const glm::dvec2& low, const glm::dvec2& high);

  std::vector<Polygon> polygons_;
  std::array<double, 2> heights_{ -unbounded, unbounded };
  Bounds bounds_;
};

} // namespace pointfront
