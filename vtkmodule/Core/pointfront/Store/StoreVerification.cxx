#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/StoreContent.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace pointfront
{
namespace
{
// Sizes are stored as floats that were rounded up; what a comparison may lose by then is the
// rounding of centre +- size in double.
constexpr double roundingShare = 0x1p-50;

glm::dvec3 slackOf(const Node& node)
{
  return (glm::abs(node.centre) + glm::dvec3(node.halfSize)) * roundingShare;
}

bool encloses(const Bounds& outer, const Bounds& inner)
{
  return outer.contains(inner.low) && outer.contains(inner.high);
}

bool boxEnclosesPoints(const Node& node, const Bounds& points)
{
  const glm::dvec3 slack = slackOf(node);
  return encloses(Bounds{ node.box().low - slack, node.box().high + slack }, points);
}

// The child's size was rounded up too, by a float's step.
bool boxEnclosesChild(const Node& node, const Node& child)
{
  const glm::dvec3 slack = slackOf(node) + glm::dvec3(child.halfSize) * 0x1p-22;
  return encloses(Bounds{ node.box().low - slack, node.box().high + slack }, child.box());
}

double farthestCorner(const glm::dvec3& from, const Bounds& box)
{
  return glm::length(glm::max(glm::abs(box.low - from), glm::abs(box.high - from)));
}

bool sphereEncloses(const Node& node, double distance)
{
  return distance <= node.radius + glm::length(slackOf(node)) + node.radius * roundingShare;
}

std::string numberText(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

/// At most some ten reports a second, each with what was done since the start.
class Pace
{
public:
  Pace(const ProgressFunction& progress, std::uint64_t total)
    : progress_(progress)
    , total_(total)
  {
  }
  bool goOn(std::uint64_t done)
  {
    const auto now = std::chrono::steady_clock::now();
    if (!progress_ || (now - last_ < std::chrono::milliseconds(100) && done != total_))
    {
      return true;
    }
    last_ = now;
    Progress report;
    report.phase = "verifying";
    report.done = done;
    report.total = total_;
    report.fraction =
      total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_);
    report.secondsElapsed = std::chrono::duration<double>(now - begin_).count();
    return progress_(report);
  }

private:
  const ProgressFunction& progress_;
  std::uint64_t total_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_{};
};
} // namespace

StoreVerification::StoreVerification(
  const PointStore& store, const StoreDescription& description, const GridBounds& gridBounds)
  : store_(store)
  , description_(description)
  , gridBounds_(gridBounds)
  , hierarchy_(*store.hierarchy())
{
  for (std::uint32_t c = 0; c < description.schema.size(); ++c)
  {
    everyColumn_.push_back(c);
    seenRanges_.push_back(emptyRange(description.schema[c]));
  }
}

Result<VerifyReport> StoreVerification::run(const ProgressFunction& progress)
{
  // Header, footer, tables and their invariants were checked by open().
  VerifyReport report;
  Pace pace(progress, description_.pointCount);
  for (NodeIndex i = 0; i < hierarchy_.nodeCount() && report.ok; ++i)
  {
    report.firstError = nodeFault(i);
    report.ok = report.firstError.empty();
    report.nodesChecked += report.ok ? 1 : 0;
    report.pointsChecked = seenPoints_;
    if (!pace.goOn(seenPoints_))
    {
      return makeError(Error::Kind::Cancelled,
        "verifying '" + description_.path + "' was cancelled after " +
          std::to_string(seenPoints_) + " points");
    }
  }
  if (report.ok)
  {
    report.firstError = totalsFault();
    report.ok = report.firstError.empty();
  }
  return report;
}

std::string StoreVerification::nodeFault(NodeIndex index)
{
  const Node& node = hierarchy_.node(index);
  if (node.parent != noNode && !boxEnclosesChild(hierarchy_.node(node.parent), node))
  {
    return "'" + description_.path + "', node " + std::to_string(index) +
      ": its box leaves the box of its parent, node " + std::to_string(node.parent);
  }
  const Result<NodeColumns> points = store_.read(index, everyColumn_);
  if (!points)
  {
    return points.error().what;
  }
  const std::string fault = pointsFault(index, *points);
  if (!fault.empty())
  {
    return "'" + description_.path + "', node " + std::to_string(index) + ": " + fault;
  }
  seenPoints_ += points->size();
  return {};
}

std::string StoreVerification::pointsFault(NodeIndex index, const NodeColumns& points)
{
  if (points.size() == 0)
  {
    return {};
  }
  glm::u32vec3 low(UINT32_MAX);
  glm::u32vec3 high(0);
  for (const glm::u32vec3& p : points.positions)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  GridBounds bounds;
  bounds.add(points.origin + GridPosition(low));
  bounds.add(points.origin + GridPosition(high));
  const Bounds box = bounds.toWorld(description_.grid);
  if (!boxEnclosesPoints(hierarchy_.node(index), box))
  {
    return "points lie outside its box";
  }
  seenBounds_.add(bounds);
  for (std::size_t c = 0; c < everyColumn_.size(); ++c)
  {
    const Attribute& attribute = description_.schema[c];
    const ColumnRange range = rangeOf(points.columns[c].data(), attribute, points.size());
    if (!encloses(description_.ranges[c], range))
    {
      return "attribute '" + attribute.name + "' has values outside the store's range";
    }
    addRange(seenRanges_[c], range);
  }
  return sphereFault(index, points, box);
}

// The sphere of a node holds the points of all nodes below it, so points are tested against the
// spheres of all ancestors; one test of their box mostly settles it.
std::string StoreVerification::sphereFault(
  NodeIndex index, const NodeColumns& points, const Bounds& box) const
{
  for (NodeIndex above = index; above != noNode; above = hierarchy_.node(above).parent)
  {
    const Node& node = hierarchy_.node(above);
    if (sphereEncloses(node, farthestCorner(node.centre, box)))
    {
      continue;
    }
    for (const glm::u32vec3& p : points.positions)
    {
      const glm::dvec3 world = description_.grid.toWorld(points.origin + GridPosition(p));
      if (!sphereEncloses(node, glm::length(world - node.centre)))
      {
        return "a point lies " + numberText(glm::length(world - node.centre)) +
          " from the centre of node " + std::to_string(above) + ", outside its sphere of radius " +
          numberText(node.radius);
      }
    }
  }
  return {};
}

std::string StoreVerification::totalsFault() const
{
  if (!(seenBounds_ == gridBounds_))
  {
    return "'" + description_.path + "': the bounds are not those of the points";
  }
  for (std::size_t c = 0; c < seenRanges_.size(); ++c)
  {
    if (seenRanges_[c].components != description_.ranges[c].components)
    {
      return "'" + description_.path + "': the range of attribute '" +
        description_.schema[c].name + "' is not that of its values";
    }
  }
  return {};
}

} // namespace pointfront
