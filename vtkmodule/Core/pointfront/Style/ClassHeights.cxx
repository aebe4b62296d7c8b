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
  for (std::uint32_t i = first; i < first + count; ++i)
  {
    heights.push_back(static_cast<float>(at(node, i)));
  }
}

double ClassHeights::at(const NodeColumns& node, std::uint32_t point) const
{
  const std::size_t layer = ranges_.size() > 1 ? node.layer : std::size_t(0);
  if (layer >= ranges_.size() || !(ranges_[layer][0] < ranges_[layer][1]))
  {
    return 0.5;
  }
  const std::array<double, 2>& range = ranges_[layer];
  const QuantisationGrid& grid = store_->description().grid;
  const double steps = static_cast<double>(node.origin.z) + node.positions[point].z;
  const double z = grid.offset.z + grid.scale.z * steps;
  return std::clamp((z - range[0]) / (range[1] - range[0]), 0.0, 1.0);
}

} // namespace pointfront
