#include "pointfront/Style/ClassHeights.h"

#include <algorithm>
#include <limits>

namespace pointfront
{

ClassHeights::ClassHeights(std::shared_ptr<const StoredCloud> store)
  : store_(std::move(store))
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t layers = store_->description().layers.size();
  ranges_.resize(std::max<std::size_t>(1, layers), { infinity, -infinity });
  for (const NodeIndex root : store_->hierarchy()->roots())
  {
    const Node node = store_->hierarchy()->node(root);
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
  // The row was read with the points a moment ago; a store of one layer is not asked at all.
  const std::size_t layer =
    ranges_.size() > 1 ? store_->hierarchy()->node(node.node).layer : std::size_t(0);
  if (layer >= ranges_.size() || !(ranges_[layer][0] < ranges_[layer][1]))
  {
    heights.insert(heights.end(), count, 0.5f);
    return;
  }
  const std::array<double, 2>& range = ranges_[layer];
  const QuantisationGrid& grid = store_->description().grid;
  for (std::uint32_t i = first; i < first + count; ++i)
  {
    const double steps = static_cast<double>(node.origin.z) + node.positions[i].z;
    const double z = grid.offset.z + grid.scale.z * steps;
    heights.push_back(
      static_cast<float>(std::clamp((z - range[0]) / (range[1] - range[0]), 0.0, 1.0)));
  }
}

} // namespace pointfront
