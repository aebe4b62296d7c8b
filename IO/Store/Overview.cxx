#include "Overview.h"

#include "PointArrays.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <optional>

namespace pointfront
{

std::vector<OverviewPart> chooseOverview(const Hierarchy& hierarchy, std::uint64_t maxPoints)
{
  std::vector<OverviewPart> parts;
  std::vector<NodeIndex> level(hierarchy.roots());
  std::uint64_t left = maxPoints;
  while (!level.empty() && left > 0)
  {
    std::sort(level.begin(), level.end());
    std::uint64_t points = 0;
    for (const NodeIndex node : level)
    {
      points += hierarchy.node(node).pointCount;
    }
    const bool whole = points <= left;
    std::vector<NodeIndex> below;
    for (const NodeIndex index : level)
    {
      const Node node = hierarchy.node(index);
      const std::uint64_t count =
        whole
          ? node.pointCount
          : static_cast<std::uint64_t>(static_cast<double>(node.pointCount) *
                                       (static_cast<double>(left) / static_cast<double>(points)));
      if (count > 0)
      {
        parts.push_back({index, static_cast<std::uint32_t>(count)});
      }
      if (whole)
      {
        hierarchy.appendChildren(index, node, below);
      }
    }
    left -= std::min(left, points);
    // With mean representatives a level stands for all above it but the leaves.
    if (hierarchy.refinement() == Refinement::Replace && whole && !below.empty())
    {
      std::uint64_t next = 0;
      for (const NodeIndex child : below)
      {
        next += hierarchy.node(child).pointCount;
      }
      std::uint64_t leaves = 0;
      for (const OverviewPart& part : parts)
      {
        leaves += hierarchy.node(part.node).leaf() ? part.pointCount : 0;
      }
      if (leaves + next > maxPoints)
      {
        break;
      }
      const auto replaced = [&](const OverviewPart& part)
      { return !hierarchy.node(part.node).leaf(); };
      parts.erase(std::remove_if(parts.begin(), parts.end(), replaced), parts.end());
      left = maxPoints - leaves;
    }
    level = std::move(below);
  }
  std::sort(parts.begin(), parts.end(),
    [](const OverviewPart& a, const OverviewPart& b) { return a.node < b.node; });
  return parts;
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
  const StoreDescription& description = store.description();
  if (std::optional<Error> damage = store.hierarchy()->fault()) // met while parts were chosen
  {
    return *damage;
  }
  std::size_t total = 0;
  for (const OverviewPart& part : parts)
  {
    total += part.pointCount;
  }
  PointArrays arrays(description, columns, total);
  std::size_t first = 0;
  for (const OverviewPart& part : parts)
  {
    if (!advance(static_cast<double>(first) / static_cast<double>(std::max<std::size_t>(total, 1))))
    {
      return makeError(Error::Kind::Cancelled, "reading of the overview was stopped");
    }
    const auto read = store.read(part.node, columns);
    if (!read)
    {
      return read.error();
    }
    arrays.addPrefix(*read, part.pointCount);
    first += part.pointCount;
  }
  arrays.moveTo(output);
  return {};
}

} // namespace pointfront
