#include "pointfront/Means/MeanCells.h"

#include "pointfront/Records/MortonOrder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pointfront
{
void MeanCells::clear()
{
  inputs_.clear();
  positions_.clear();
}

void MeanCells::add(
  const RecordSpan& records, const std::vector<std::uint32_t>& held, bool original)
{
  for (const std::uint32_t i : held)
  {
    inputs_.push_back({ records.record(i), original });
    positions_.push_back(records.position(i));
  }
}

void MeanCells::sort()
{
  std::vector<std::uint32_t> order(inputs_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return mortonLess(positions_[a], positions_[b]); });
  std::vector<MeanInput> inputs;
  std::vector<TreePosition> positions;
  inputs.reserve(order.size());
  positions.reserve(order.size());
  for (const std::uint32_t i : order)
  {
    inputs.push_back(inputs_[i]);
    positions.push_back(positions_[i]);
  }
  inputs_ = std::move(inputs);
  positions_ = std::move(positions);
}

CellOccupancy MeanCells::occupancy() const
{
  std::vector<std::uint8_t> steps(positions_.size());
  for (std::size_t i = 1; i < steps.size(); ++i)
  {
    steps[i] = static_cast<std::uint8_t>(differingBits(positions_[i], positions_[i - 1]));
  }
  return cellOccupancy(steps.data(), steps.size());
}

std::vector<std::byte> MeanCells::represent(const CellOccupancy& occupancy, unsigned log2Side,
  unsigned finest, double stepLength, BuiltNode& node)
{
  // At most twice the node's capacity.
  const std::uint64_t most =
    std::min<std::uint64_t>(2ull * rule_.nodePoints, inputs_.size() / leastShare_);
  unsigned cell = std::min(finest, log2Side);
  while (cell < log2Side && occupancy.distinct[cell] > most)
  {
    ++cell;
  }
  node.samplingQuarters = 4 * static_cast<int>(cell);
  node.row.spacing = static_cast<float>(std::ldexp(stepLength, static_cast<int>(cell)));
  std::vector<std::byte> means(occupancy.distinct[cell] * form_.bytes());
  std::byte* out = means.data();
  for (std::size_t begin = 0; begin < inputs_.size(); out += form_.bytes())
  {
    std::size_t end = begin + 1;
    while (end < inputs_.size() && differingBits(positions_[end], positions_[begin]) <= cell)
    {
      ++end;
    }
    form_.summarise(inputs_, begin, end, out);
    form_.forgetSplat(out);
    begin = end;
  }
  return means;
}

std::vector<std::byte> MeanCells::alone(
  const RecordSpan& records, const std::vector<std::uint32_t>& held)
{
  clear();
  add(records, held, true);
  std::vector<std::byte> packed(held.size() * form_.bytes());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    form_.summarise(inputs_, i, i + 1, packed.data() + i * form_.bytes());
  }
  return packed;
}

} // namespace pointfront
