#include "pointfront/Tiles/TilePlacing.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pointfront
{
namespace
{
/// A quotient so near to an integer is one: scales and offsets are decimal fractions.
std::optional<std::int64_t> wholeNumber(double value)
{
  constexpr double tolerance = 1e-6;
  constexpr double most = 4503599627370496.0; // 2^52
  const double nearest = std::round(value);
  return std::abs(value - nearest) <= tolerance && std::abs(nearest) <= most
    ? std::optional<std::int64_t>(static_cast<std::int64_t>(nearest))
    : std::nullopt;
}
} // namespace

QuantisationGrid TilePlacing::commonGrid(const std::vector<QuantisationGrid>& grids)
{
  QuantisationGrid common = grids.front();
  for (const QuantisationGrid& grid : grids)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (grid.scale[axis] < common.scale[axis] * (1.0 - 1e-9))
      {
        common.scale[axis] = grid.scale[axis];
        common.offset[axis] = grid.offset[axis];
      }
    }
  }
  return common;
}

TilePlacing::TilePlacing(const QuantisationGrid& own, const QuantisationGrid& common)
  : own_(own)
  , common_(common)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto ratio = wholeNumber(own.scale[axis] / common.scale[axis]);
    const auto shift = wholeNumber((own.offset[axis] - common.offset[axis]) / common.scale[axis]);
    exact_ = exact_ && ratio && *ratio > 0 && shift;
    ratio_[axis] = ratio.value_or(1);
    shift_[axis] = shift.value_or(0);
  }
}

GridPosition TilePlacing::placed(const GridPosition& step) const
{
  return exact_ ? step * ratio_ + shift_ : common_.toGrid(own_.toWorld(step));
}

ValueRange TilePlacing::placed(const ValueRange& steps, int axis) const
{
  if (steps.empty())
  {
    return steps;
  }
  if (exact_)
  {
    const auto ratio = static_cast<double>(ratio_[axis]);
    const auto shift = static_cast<double>(shift_[axis]);
    return { steps.low * ratio + shift, steps.high * ratio + shift };
  }
  // The rounding of a point is not that of the ends: a step of room on either side.
  const auto common = [&](double step)
  {
    const double world = step * own_.scale[axis] + own_.offset[axis];
    return (world - common_.offset[axis]) / common_.scale[axis];
  };
  return { std::floor(common(steps.low)) - 1.0, std::ceil(common(steps.high)) + 1.0 };
}

Result<void> TilePlacing::place(NodeColumns& node, const std::string& path) const
{
  if (exact_ && ratio_ == GridPosition(1))
  {
    node.origin += shift_;
    return {};
  }
  std::vector<GridPosition> steps(node.positions.size());
  GridPosition low(std::numeric_limits<std::int64_t>::max());
  GridPosition high(std::numeric_limits<std::int64_t>::min());
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    steps[i] = placed(node.origin + GridPosition(node.positions[i]));
    low = glm::min(low, steps[i]);
    high = glm::max(high, steps[i]);
  }
  if (steps.empty())
  {
    return {};
  }
  const GridPosition extent = high - low;
  if (std::max({ extent.x, extent.y, extent.z }) > std::numeric_limits<std::uint32_t>::max())
  {
    return makeError(Error::Kind::Unsupported,
      path +
        ": a node of it is wider than 32 bits of steps of the finest store beside it; build "
        "them with one --precision");
  }
  node.origin = low;
  std::transform(steps.begin(), steps.end(), node.positions.begin(),
    [&low](const GridPosition& step) { return glm::u32vec3(step - low); });
  return {};
}

} // namespace pointfront
