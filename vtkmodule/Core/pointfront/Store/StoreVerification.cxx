#include "pointfront/Store/StoreVerification.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/NodeTableSection.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Threads/WorkerThread.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <new>

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

std::string allDigits(double value)
{
  return numberText(value, 17);
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
    report.fraction = total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_);
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

void SeenPoints::add(const SeenPoints& other)
{
  bounds.add(other.bounds);
  for (std::size_t c = 0; c < ranges.size(); ++c)
  {
    addRange(ranges[c], other.ranges[c]);
  }
}

/// State that the threads of one run share.
struct StoreVerification::Walk
{
  Walk(SeenPoints nothing, const ProgressFunction& progress, std::uint64_t total)
    : seen(std::move(nothing))
    , pace(progress, total)
  {
  }
  std::atomic<NodeIndex> next{ 0 };
  std::atomic<NodeIndex> faulty{ noNode }; ///< the lowest so far: nodes beyond it do not matter
  std::atomic<bool> cancelled{ false };
  std::mutex mutex; ///< guards what follows
  std::string fault; ///< fault of node `faulty`
  SeenPoints seen;
  std::uint64_t done = 0;
  Pace pace;
};

StoreVerification::StoreVerification(const StoredCloud& cloud, const GridBounds& gridBounds)
  : cloud_(cloud)
  , description_(cloud.description())
  , gridBounds_(gridBounds)
  , hierarchy_(*cloud.hierarchy())
{
  for (std::uint32_t c = 0; c < description_.schema.size(); ++c)
  {
    everyColumn_.push_back(c);
  }
}

SeenPoints StoreVerification::nothingSeen() const
{
  SeenPoints seen;
  for (const Attribute& attribute : description_.schema)
  {
    seen.ranges.push_back(emptyRange(attribute));
  }
  return seen;
}

Result<VerifyReport> StoreVerification::run(const ProgressFunction& progress)
{
  // Header, footer and description were checked by open().
  std::string fault = tableFault();
  fault = fault.empty() ? readNodeRanges() : fault;
  if (!fault.empty())
  {
    VerifyReport report;
    report.ok = false;
    report.firstError = std::move(fault);
    return report;
  }
  Walk walk(nothingSeen(), progress, description_.pointCount);
  ThreadCrew crew(threadsOr(0));
  try
  {
    crew.run(crew.threads(), [&](std::size_t, unsigned) { work(walk); });
  }
  catch (const std::bad_alloc&)
  {
    return makeError(
      Error::Kind::NoMemory, "not enough memory to verify '" + description_.path + "'");
  }
  if (walk.cancelled)
  {
    return makeError(Error::Kind::Cancelled,
      "verifying '" + description_.path + "' was cancelled after " + std::to_string(walk.done) +
        " points");
  }
  // Nodes were taken in order: all below the faulty one are sound.
  VerifyReport report;
  report.firstError = walk.faulty != noNode ? walk.fault : totalsFault(walk.seen);
  report.ok = report.firstError.empty();
  report.nodesChecked = std::min<NodeIndex>(walk.faulty, hierarchy_.nodeCount());
  for (NodeIndex i = 0; i < report.nodesChecked; ++i)
  {
    report.pointsChecked += originalPoints(hierarchy_.node(i), hierarchy_.refinement());
  }
  return report;
}

/// The node table, every page of it, and what the description says of it.
std::string StoreVerification::tableFault() const
{
  const std::string fault =
    nodeTableFault(hierarchy_, description_.layers.size(), description_.pointCount);
  if (const std::optional<Error> damage = hierarchy_.fault())
  {
    return damage->what;
  }
  if (!fault.empty())
  {
    return "'" + description_.path + "', " + fault;
  }
  std::uint64_t number = 0;
  for (NodeIndex i = 0; i < hierarchy_.nodeCount(); ++i)
  {
    const Node node = hierarchy_.node(i);
    if (node.firstPoint != number)
    {
      return "'" + description_.path + "', node " + std::to_string(i) +
        ": the number of its first point is " + std::to_string(node.firstPoint) + " instead of " +
        std::to_string(number);
    }
    number += node.pointCount;
  }
  StoreDescription counted = description_;
  countLayers(hierarchy_, counted);
  for (std::size_t l = 0; l < counted.layers.size(); ++l)
  {
    if (counted.layers[l].pointCount != description_.layers[l].pointCount ||
      counted.layers[l].nodeCount != description_.layers[l].nodeCount)
    {
      return "'" + description_.path + "': the counts of layer '" + counted.layers[l].name +
        "' are not those of its nodes";
    }
  }
  return counted.levels == description_.levels
    ? ""
    : "'" + description_.path + "': the number of levels is not that of the nodes";
}

std::string StoreVerification::readNodeRanges()
{
  for (std::uint32_t c = 0; c < rangeComponents(description_.schema); ++c)
  {
    const auto ranges = cloud_.nodeRanges(c);
    if (!ranges)
    {
      return ranges.error().what;
    }
    if (!*ranges)
    {
      nodeRanges_.clear();
      break;
    }
    nodeRanges_.push_back(*ranges);
  }
  return {};
}

/// The range below a node must hold the ranges of its children and of the nodes below these.
std::string StoreVerification::rangesFault(NodeIndex index, const Node& node) const
{
  const auto holds = [](const ValueRange& outer, const ValueRange& inner)
  { return inner.empty() || (outer.low <= inner.low && inner.high <= outer.high); };
  for (const std::shared_ptr<const NodeRanges>& ranges : nodeRanges_)
  {
    const ValueRange below = ranges->below(index);
    const bool inParent = node.parent == noNode || holds(ranges->below(node.parent), below);
    if (!holds(below, ranges->own(index)) || !inParent)
    {
      return "its ranges are not within those of the nodes above it";
    }
  }
  return {};
}

bool StoreVerification::knownToHave(
  NodeIndex index, std::uint32_t component, const ValueRange& values) const
{
  if (nodeRanges_.empty() || values.empty())
  {
    return true;
  }
  const ValueRange own = nodeRanges_[component]->own(index);
  return own.low <= values.low && values.high <= own.high;
}

void StoreVerification::work(Walk& walk) const
{
  SeenPoints own = nothingSeen();
  for (NodeIndex i = walk.next++; i < hierarchy_.nodeCount(); i = walk.next++)
  {
    if (walk.cancelled || i > walk.faulty)
    {
      break;
    }
    const std::string fault = nodeFault(i, own);
    const std::lock_guard<std::mutex> lock(walk.mutex);
    if (!fault.empty() && i < walk.faulty)
    {
      walk.faulty = i;
      walk.fault = fault;
    }
    walk.done += originalPoints(hierarchy_.node(i), hierarchy_.refinement());
    if (!walk.cancelled && !walk.pace.goOn(walk.done))
    {
      walk.cancelled = true;
    }
  }
  const std::lock_guard<std::mutex> lock(walk.mutex);
  walk.seen.add(own);
}

std::string StoreVerification::nodeFault(NodeIndex index, SeenPoints& seen) const
{
  const Node node = hierarchy_.node(index);
  if (node.parent != noNode && !boxEnclosesChild(hierarchy_.node(node.parent), node))
  {
    return "'" + description_.path + "', node " + std::to_string(index) +
      ": its box leaves the box of its parent, node " + std::to_string(node.parent);
  }
  const Result<NodeColumns> points = cloud_.read(index, everyColumn_);
  if (!points)
  {
    return points.error().what;
  }
  std::string fault = rangesFault(index, node);
  fault = fault.empty() ? pointsFault(index, *points, seen) : fault;
  if (!fault.empty())
  {
    return "'" + description_.path + "', node " + std::to_string(index) + ": " + fault;
  }
  return {};
}

std::string StoreVerification::pointsFault(
  NodeIndex index, const NodeColumns& points, SeenPoints& seen) const
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
  std::uint32_t component = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!knownToHave(index, component++,
          { static_cast<double>(bounds.low[axis]), static_cast<double>(bounds.high[axis]) }))
    {
      return "points lie outside the node's ranges";
    }
  }
  seen.bounds.add(bounds);
  for (std::size_t c = 0; c < everyColumn_.size(); ++c)
  {
    const Attribute& attribute = description_.schema[c];
    const ColumnRange range = rangeOf(points.columns[c].data(), attribute, points.size());
    if (!encloses(description_.ranges[c], range))
    {
      return "attribute '" + attribute.name + "' has values outside the store's range";
    }
    for (const std::array<double, 2>& values : range.components)
    {
      if (!knownToHave(index, component++, { values[0], values[1] }))
      {
        return "attribute '" + attribute.name + "' has values outside the node's range";
      }
    }
    addRange(seen.ranges[c], range);
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
    const Node node = hierarchy_.node(above);
    if (sphereEncloses(node, farthestCorner(node.centre, box)))
    {
      continue;
    }
    for (const glm::u32vec3& p : points.positions)
    {
      const glm::dvec3 world = description_.grid.toWorld(points.origin + GridPosition(p));
      if (!sphereEncloses(node, glm::length(world - node.centre)))
      {
        return "a point lies " + allDigits(glm::length(world - node.centre)) +
          " from the centre of node " + std::to_string(above) + ", outside its sphere of radius " +
          allDigits(node.radius);
      }
    }
  }
  return {};
}

std::string StoreVerification::totalsFault(const SeenPoints& seen) const
{
  if (!(seen.bounds == gridBounds_))
  {
    return "'" + description_.path + "': the bounds are not those of the points";
  }
  for (std::size_t c = 0; c < seen.ranges.size(); ++c)
  {
    if (seen.ranges[c].components != description_.ranges[c].components)
    {
      return "'" + description_.path + "': the range of attribute '" + description_.schema[c].name +
        "' is not that of its values";
    }
  }
  return {};
}

} // namespace pointfront
