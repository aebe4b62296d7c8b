#pragma once

#include "pointfront/Trees/Sampler.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pointfront
{

/// Weighted by points, in squares, as discs cover; what was not measured does not count.
template <typename Branch>
float mergedSplatRadius(const Branch& a, const Branch& b)
{
  double sum = 0.0;
  double points = 0.0;
  for (const Branch* branch : { &a, &b })
  {
    const double radius = branch->node->row.splatRadius;
    const double count = radius > 0.0 ? double(branch->held.size()) : 0.0;
    sum += count * radius * radius;
    points += count;
  }
  return points > 0.0 ? static_cast<float>(std::sqrt(sum / points)) : 0.0f;
}

/// Leaves of one parent grow together as long as one node holds their points: an octree over a
/// surface has many slivers, and a node of some hundred points costs the front, the disk and the
/// GPU as much as a full one. A leaf without points of its own goes away.
/// A branch has `node` (a BuiltNode) and `held`, numbers of records; those of leaves are numbers in
/// one and the same array.
/// Spacing   of a surface is sqrt(area / places), and areas add up. A leaf of one place has no
/// area,
///           so what grows out of a few places is measured again.
/// `view(branch)`: the array of a leaf's points, which are in Morton order, as those of the
/// children together are. `stepLength`: of a tree step.
template <typename Branch, typename View>
void mergeLeaves(
  std::vector<Branch>& children, std::uint32_t nodePoints, const View& view, double stepLength)
{
  constexpr std::uint64_t fewPlaces = 8;
  const auto places = [&](const Branch& b) { return placesOf(view(b), b.held); };
  const auto area = [&](const Branch& b)
  { return double(b.node->row.spacing) * b.node->row.spacing * double(places(b)); };
  std::vector<Branch> merged;
  std::size_t grown = SIZE_MAX; // the leaf in `merged` that takes in others
  for (Branch& child : children)
  {
    const std::size_t points = child.held.size();
    const bool leaf = child.node->children.empty();
    if (leaf && points == 0)
    {
      continue;
    }
    if (!leaf || grown == SIZE_MAX || merged[grown].held.size() + points > nodePoints)
    {
      grown = leaf ? merged.size() : grown;
      merged.push_back(std::move(child));
      continue;
    }
    Branch& into = merged[grown];
    const double all = area(into) + area(child);
    into.node->row.splatRadius = mergedSplatRadius(into, child);
    into.held.insert(into.held.end(), child.held.begin(), child.held.end());
    const std::uint64_t grownPlaces = places(into);
    into.node->row.spacing = static_cast<float>(grownPlaces <= fewPlaces
        ? surfaceSpacing(view(into), into.held) * stepLength
        : std::sqrt(all / double(grownPlaces)));
  }
  children = std::move(merged);
}

} // namespace pointfront
