#include "pointfront/Query/LineCorridor.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// Distances of a box are told from its centre; what rounding may do to them, with room.
constexpr double relativeMargin = 1e-12;

} // namespace

Result<std::shared_ptr<const LineCorridor>> LineCorridor::make(
  const std::vector<PlanarLine>& lines, double distance, const std::array<double, 2>& heights)
{
  if (!std::isfinite(distance) || distance < 0.0 || std::isnan(heights[0]) ||
    std::isnan(heights[1]))
  {
    return makeError(Error::Kind::BadArgument,
      "a corridor's distance is finite and 0 or more, and its heights are numbers");
  }
  std::shared_ptr<LineCorridor> corridor(new LineCorridor);
  corridor->distance_ = distance;
  corridor->heights_ = heights;
  const double reach = distance * (1.0 + relativeMargin);
  for (const PlanarLine& line : lines)
  {
    const bool places = std::all_of(line.begin(), line.end(),
      [](const glm::dvec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); });
    if (line.empty() || !places)
    {
      return makeError(
        Error::Kind::BadArgument, "a corridor's line has no vertex, or one that is not finite");
    }
    for (std::size_t i = 0; i == 0 || i + 1 < line.size(); ++i)
    {
      const glm::dvec2 to = line[std::min(i + 1, line.size() - 1)];
      corridor->segments_.push_back({ line[i], to - line[i] });
    }
    for (const glm::dvec2& v : line)
    {
      const glm::dvec2 room(
        reach + relativeMargin * std::abs(v.x), reach + relativeMargin * std::abs(v.y));
      corridor->bounds_.add(glm::dvec3(v - room, heights[0]));
      corridor->bounds_.add(glm::dvec3(v + room, heights[1]));
    }
  }
  if (!(heights[0] <= heights[1]))
  {
    corridor->segments_.clear();
    corridor->bounds_ = Bounds();
  }
  return std::shared_ptr<const LineCorridor>(std::move(corridor));
}

double LineCorridor::Segment::squaredDistance(const glm::dvec2& p) const
{
  const glm::dvec2 offset = p - from;
  const double squaredLength = glm::dot(along, along);
  const double place =
    squaredLength > 0.0 ? std::clamp(glm::dot(offset, along) / squaredLength, 0.0, 1.0) : 0.0;
  const glm::dvec2 across = offset - place * along;
  return glm::dot(across, across);
}

bool LineCorridor::contains(const glm::dvec3& point) const
{
  const double most = distance_ * distance_;
  return point.z >= heights_[0] && point.z <= heights_[1] &&
    std::any_of(segments_.begin(), segments_.end(),
      [&](const Segment& segment) { return segment.squaredDistance(glm::dvec2(point)) <= most; });
}

Overlap LineCorridor::overlapSegment(
  const Segment& segment, const glm::dvec2& centre, double halfDiagonal) const
{
  const double away = std::sqrt(segment.squaredDistance(centre));
  const double margin = relativeMargin *
    (distance_ + halfDiagonal + glm::length(centre - segment.from) + glm::length(segment.along));
  if (away - halfDiagonal > distance_ + margin)
  {
    return Overlap::Outside;
  }
  return away + halfDiagonal < distance_ - margin ? Overlap::Inside : Overlap::Crossing;
}

Overlap LineCorridor::overlap(const Bounds& box) const
{
  if (box.empty() || box.low.z > heights_[1] || box.high.z < heights_[0])
  {
    return Overlap::Outside;
  }
  const glm::dvec2 centre(box.centre());
  const double halfDiagonal = 0.5 * glm::length(glm::dvec2(box.size()));
  Overlap most = Overlap::Outside;
  for (const Segment& segment : segments_)
  {
    most = std::max(most, overlapSegment(segment, centre, halfDiagonal));
  }
  const bool between = box.low.z >= heights_[0] && box.high.z <= heights_[1];
  return most == Overlap::Inside && !between ? Overlap::Crossing : most;
}

void LineCorridor::keepInside(
  const Bounds& box, const glm::dvec3* points, std::size_t count, std::uint8_t* keep) const
{
  const glm::dvec2 centre(box.centre());
  const double halfDiagonal = 0.5 * glm::length(glm::dvec2(box.size()));
  LineCorridor nearby;
  nearby.distance_ = distance_;
  nearby.heights_ = heights_;
  std::copy_if(segments_.begin(), segments_.end(), std::back_inserter(nearby.segments_),
    [&](const Segment& segment)
    { return overlapSegment(segment, centre, halfDiagonal) != Overlap::Outside; });
  for (std::size_t i = 0; i < count; ++i)
  {
    keep[i] = keep[i] != 0 && nearby.contains(points[i]) ? 1 : 0;
  }
}

} // namespace pointfront
