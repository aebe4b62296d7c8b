#include "pointfront/Style/ClassHeights.h"

#include <algorithm>
#include <limits>

namespace pointfront
{

ClassHeights::ClassHeights(std::shared_ptr<const StoredCloud> store)
  : ClassHeights(store->description(), *store->hierarchy())
{
  store_ = std::move(store);
}

ClassHeights::ClassHeights(const StoreDescription& store, const Hierarchy& hierarchy)
  : grid_(store.grid)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ranges_.resize(std::max<std::size_t>(1, store.layers.size()), { infinity, -infinity });
  for (const NodeIndex root : hierarchy.roots())
  {
    const Node node = hierarchy.node(root);
    if (node.layer < ranges_.size() && node.pointsBelow > 0)
    {
      std::array<double, 2>& range = ranges_[node.layer];
      range = { std::min(range[0], node.box().low.z), std::max(range[1], node.box().high.z) };
    }
  }
}

void ClassHeights::append(const NodeColumns& node, std::uint32_t first, std::uint32_t count,
  std::vector<float>& heights) const
{
  for (std::uint32_t i = first; i < first + count; ++i)
  {
    heights.push_back(static_cast<float>(at(node, i)));
  }
}

double ClassHeights::at(const NodeColumns& node, std::uint32_t point) const
{
  const std::size_t layer = ranges_.size() > 1 ? node.layer : std::size_t(0);
  const double steps = static_cast<double>(node.origin.z) + node.positions[point].z;
  return layer < ranges_.size() ? heightOf(grid_.offset.z + grid_.scale.z * steps, ranges_[layer])
                                : 0.5;
}

double ClassHeights::heightOf(double z, const std::array<double, 2>& range)
{
  return range[0] < range[1] ? std::clamp((z - range[0]) / (range[1] - range[0]), 0.0, 1.0) : 0.5;
}

std::array<double, 2> ClassHeights::between(double low, double high) const
{
  std::array<double, 2> heights{ 1.0, 0.0 };
  for (const std::array<double, 2>& range : ranges_)
  {
    heights = { std::min(heights[0], heightOf(low, range)),
      std::max(heights[1], heightOf(high, range)) };
  }
  return heights;
}

} // namespace pointfront
