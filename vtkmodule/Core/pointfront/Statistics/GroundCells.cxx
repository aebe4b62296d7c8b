#include "pointfront/Statistics/GroundCells.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{

GroundCells::GroundCells(const Bounds& bounds, std::uint64_t points)
{
  if (bounds.empty() || points == 0)
  {
    return;
  }
  low_ = bounds.low;
  const glm::dvec3 size = bounds.size();
  double side = std::sqrt(pointsOfCell * size.x * (size.y / static_cast<double>(points)));
  if (!(side > 0.0) || !std::isfinite(side))
  {
    return;
  }
  const auto along = [&side](double length) { return std::floor(length / side) + 1.0; };
  while (along(size.x) * along(size.y) > static_cast<double>(mostCells))
  {
    side *= 2.0;
  }
  cellSize_ = side;
  columns_ = static_cast<std::size_t>(along(size.x));
  rows_ = static_cast<std::size_t>(along(size.y));
  bits_ = std::vector<std::atomic<std::uint64_t>>((columns_ * rows_ + 63) / 64);
}

void GroundCells::add(const glm::dvec3& point)
{
  if (bits_.empty())
  {
    return;
  }
  const auto column = static_cast<std::size_t>((point.x - low_.x) / cellSize_);
  const auto row = static_cast<std::size_t>((point.y - low_.y) / cellSize_);
  const std::size_t cell = std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1);
  const std::uint64_t bit = std::uint64_t(1) << (cell % 64);
  std::atomic<std::uint64_t>& word = bits_[cell / 64];
  if ((word.load(std::memory_order_relaxed) & bit) == 0)
  {
    word.fetch_or(bit, std::memory_order_relaxed);
  }
}

std::uint64_t GroundCells::occupied() const
{
  std::uint64_t count = 0;
  for (const std::atomic<std::uint64_t>& word : bits_)
  {
    for (std::uint64_t rest = word.load(std::memory_order_relaxed); rest != 0; rest &= rest - 1)
    {
      ++count;
    }
  }
  return count;
}

} // namespace pointfront
