#include "Overview.h"

#include "LocatedPoints.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace pointfront
{
namespace
{

/// A node gives at most this share of its own points where more lie below: finer parts follow the
/// cloud's density more closely, and more nodes are read.
constexpr std::uint64_t ownShare = 2;

/// Chooses parts of a subtree: as many points as it is allotted.
class OverviewChoice
{
public:
  explicit OverviewChoice(const Hierarchy& hierarchy)
    : hierarchy_(hierarchy)
  {
  }

  void allot(NodeIndex index, std::uint64_t points)
  {
    const Node node = hierarchy_.node(index);
    if (points == 0)
    {
      return;
    }
    if (node.leaf() || (points * ownShare <= node.pointCount && points < node.pointsBelow))
    {
      this->take(index, std::min<std::uint64_t>(points, node.pointCount));
      return;
    }
    std::vector<NodeIndex> children;
    hierarchy_.appendChildren(index, node, children);
    const std::uint64_t rest = this->allotShares(children, points);
    // Own points only when those below do not suffice: how they are spread below is not known.
    this->take(index, std::min<std::uint64_t>(rest, originalPoints(node, hierarchy_.refinement())));
  }

  /// To each node its share of the points below them all. Returns what they do not have.
  std::uint64_t allotShares(const std::vector<NodeIndex>& nodes, std::uint64_t points)
  {
    std::uint64_t total = 0;
    for (const NodeIndex node : nodes)
    {
      total += hierarchy_.node(node).pointsBelow;
    }
    const std::uint64_t given = std::min(points, total);
    const double share = total > 0 ? static_cast<double>(given) / static_cast<double>(total) : 0.0;
    const auto upTo = [&](std::uint64_t before)
    {
      return before == total ? given
                             : static_cast<std::uint64_t>(share * static_cast<double>(before));
    };
    std::uint64_t before = 0;
    for (const NodeIndex node : nodes)
    {
      const std::uint64_t after = before + hierarchy_.node(node).pointsBelow;
      this->allot(node, upTo(after) - upTo(before));
      before = after;
    }
    return points - given;
  }

  std::vector<OverviewPart> parts()
  {
    std::sort(parts_.begin(), parts_.end(),
      [](const OverviewPart& a, const OverviewPart& b) { return a.node < b.node; });
    return std::move(parts_);
  }

private:
  void take(NodeIndex node, std::uint64_t points)
  {
    if (points > 0)
    {
      parts_.push_back({ node, static_cast<std::uint32_t>(points) });
    }
  }

  const Hierarchy& hierarchy_;
  std::vector<OverviewPart> parts_;
};

} // namespace

std::vector<OverviewPart> chooseOverview(const Hierarchy& hierarchy, std::uint64_t maxPoints)
{
  OverviewChoice choice(hierarchy);
  choice.allotShares(hierarchy.roots(), maxPoints);
  return choice.parts();
}

std::vector<OverviewPart> overviewPiece(
  const std::vector<OverviewPart>& parts, int piece, int pieces)
{
  std::uint64_t total = 0;
  for (const OverviewPart& part : parts)
  {
    total += part.pointCount;
  }
  std::vector<OverviewPart> chosen;
  std::uint64_t before = 0;
  for (const OverviewPart& part : parts)
  {
    // A part belongs to the piece in which its middle point lies.
    const std::uint64_t middle = before + part.pointCount / 2;
    const auto owner =
      middle * static_cast<std::uint64_t>(pieces) / std::max<std::uint64_t>(total, 1);
    if (owner == static_cast<std::uint64_t>(piece))
    {
      chosen.push_back(part);
    }
    before += part.pointCount;
  }
  return chosen;
}

Result<void> fillOverview(const StoredCloud& store, const std::vector<OverviewPart>& parts,
  const ColumnSelection& columns, vtkPolyData* output, const std::function<bool(double)>& advance)
{
  if (std::optional<Error> damage = store.hierarchy()->fault()) // met while parts were chosen
  {
    return *damage;
  }
  if (!advance(0.0))
  {
    return makeError(Error::Kind::Cancelled, "reading of the overview was stopped");
  }
  std::vector<NodeRows> points;
  points.reserve(parts.size());
  for (const OverviewPart& part : parts)
  {
    points.push_back({ part.node, std::vector<std::uint32_t>(part.pointCount) });
    std::iota(points.back().rows.begin(), points.back().rows.end(), 0u);
  }
  QueryOptions options;
  options.progress = [&advance](const Progress& progress) { return advance(progress.fraction); };
  return fillPoints(store, points, columns, options, output);
}

} // namespace pointfront
