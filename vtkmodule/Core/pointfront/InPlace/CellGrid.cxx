#include "pointfront/InPlace/CellGrid.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
constexpr unsigned maxTopBits = 12;
constexpr unsigned cutBits = 3; ///< a cell is cut into 2^3 x 2^3
constexpr std::uint32_t cutFlag = 0x80000000u;
constexpr std::uint32_t mostCounted = 0x40000000u;
constexpr std::uint64_t pointsPerCell = 32;

/// Bits of v to the even places.
std::uint32_t spread(std::uint32_t v)
{
  v = (v | (v << 8)) & 0x00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0fu;
  v = (v | (v << 2)) & 0x33333333u;
  return (v | (v << 1)) & 0x55555555u;
}

std::uint32_t morton(std::uint32_t x, std::uint32_t y)
{
  return spread(x) | (spread(y) << 1);
}

/// Bits that hold every value from 0 to `extent`.
unsigned bitsFor(std::uint64_t extent)
{
  unsigned bits = 0;
  for (; extent != 0; extent >>= 1)
  {
    ++bits;
  }
  return bits;
}

unsigned frameBitsOf(const RecordBox& box)
{
  if (box.empty())
  {
    return 0;
  }
  const auto extent = [&box](int axis)
  { return static_cast<std::uint64_t>(std::int64_t(box.high[axis]) - box.low[axis]); };
  return bitsFor(std::max(extent(0), extent(1)));
}
} // namespace

unsigned CellGrid::topBitsFor(std::uint64_t points)
{
  unsigned bits = 0;
  while (bits < maxTopBits && (points >> (2 * bits)) > pointsPerCell)
  {
    ++bits;
  }
  return bits;
}

CellGrid::CellGrid(const RecordBox& box, unsigned topBits)
  : box_(box)
  , frameBits_(frameBitsOf(box))
  , topBits_(std::min({ topBits, frameBits_, maxTopBits }))
{
  logSides_.push_back(frameBits_ - topBits_);
  addLevel(std::size_t(1) << (2 * topBits_));
}

void CellGrid::addLevel(std::size_t cells)
{
  levels_.emplace_back(new std::atomic<std::uint32_t>[cells]);
  sizes_.push_back(cells);
  for (std::size_t i = 0; i < cells; ++i)
  {
    levels_.back()[i].store(0, std::memory_order_relaxed);
  }
}

std::uint32_t CellGrid::cell(std::uint32_t level, std::uint32_t index) const
{
  return levels_[level][index].load(std::memory_order_relaxed);
}

unsigned CellGrid::bitsOf(std::uint32_t level) const
{
  return level == 0 ? topBits_ : logSides_[level - 1] - logSides_[level];
}

CellGrid::CellNumber CellGrid::find(const glm::ivec3& position) const
{
  // Modulo the frame: a file that somebody changes while it is read cannot lead outside.
  const std::uint64_t frame = (std::uint64_t(1) << frameBits_) - 1;
  const auto x = static_cast<std::uint64_t>(std::int64_t(position.x) - box_.low.x) & frame;
  const auto y = static_cast<std::uint64_t>(std::int64_t(position.y) - box_.low.y) & frame;
  CellNumber number{ 0,
    morton(static_cast<std::uint32_t>(x >> logSides_[0]),
      static_cast<std::uint32_t>(y >> logSides_[0])) };
  for (std::uint32_t value = cell(0, number.index); (value & cutFlag) != 0;
       value = cell(number.level, number.index))
  {
    ++number.level;
    const std::uint32_t mask = (1u << bitsOf(number.level)) - 1;
    const unsigned side = logSides_[number.level];
    number.index = (value & ~cutFlag) * (1u << (2 * cutBits)) +
      morton(
        static_cast<std::uint32_t>(x >> side) & mask, static_cast<std::uint32_t>(y >> side) & mask);
  }
  return number;
}

std::uint32_t CellGrid::at(const glm::ivec3& position) const
{
  const CellNumber number = find(position);
  return cell(number.level, number.index);
}

void CellGrid::count(const GridRecords& records, std::uint64_t begin, std::uint64_t end)
{
  const auto newest = static_cast<std::uint32_t>(levels_.size() - 1);
  CellNumber last{ 0, 0 };
  std::uint32_t same = 0; // neighbours in the file mostly fall into one cell: one addition for all
  const auto flush = [&]()
  {
    if (same > 0 && last.level == newest && cell(last.level, last.index) < mostCounted)
    {
      levels_[last.level][last.index].fetch_add(same, std::memory_order_relaxed);
    }
    same = 0;
  };
  for (std::uint64_t i = begin; i < end; ++i)
  {
    const CellNumber number = find(records.position(i));
    if (number.index != last.index || number.level != last.level || same == mostCounted / 64)
    {
      flush();
      last = number;
    }
    ++same;
  }
  flush();
}

bool CellGrid::refine(std::uint32_t capacity)
{
  const std::size_t newest = levels_.size() - 1;
  if (logSides_[newest] == 0)
  {
    return false; // cells are single grid positions
  }
  std::uint32_t blocks = 0;
  for (std::size_t i = 0; i < sizes_[newest]; ++i)
  {
    if (levels_[newest][i].load(std::memory_order_relaxed) > capacity)
    {
      levels_[newest][i].store(cutFlag | blocks++, std::memory_order_relaxed);
    }
  }
  if (blocks == 0)
  {
    return false;
  }
  logSides_.push_back(logSides_[newest] - std::min(cutBits, logSides_[newest]));
  addLevel(std::size_t(blocks) << (2 * cutBits));
  return true;
}

CellGrid::Range CellGrid::quadrant(const Range& range, unsigned which)
{
  assert(range.bits > 0 && which < 4);
  Range part = range;
  --part.bits;
  --part.square.logSide;
  part.first += which << (2 * part.bits);
  part.square.x += std::uint64_t(which & 1) << part.square.logSide;
  part.square.y += std::uint64_t(which >> 1) << part.square.logSide;
  return part;
}

bool CellGrid::cut(const Range& range, Range& inside) const
{
  const std::uint32_t value = cell(range.level, range.first);
  if (range.bits > 0 || (value & cutFlag) == 0)
  {
    return false;
  }
  inside = { range.level + 1, (value & ~cutFlag) << (2 * cutBits), bitsOf(range.level + 1),
    range.square };
  return true;
}

void CellGrid::assign(const Range& range, std::uint32_t leaf)
{
  for (std::uint32_t i = 0; i < (1u << (2 * range.bits)); ++i)
  {
    levels_[range.level][range.first + i].store(leaf, std::memory_order_relaxed);
  }
}

glm::ivec2 CellGrid::low(const Square& square) const
{
  return { static_cast<int>(box_.low.x + static_cast<std::int64_t>(square.x)),
    static_cast<int>(box_.low.y + static_cast<std::int64_t>(square.y)) };
}

glm::ivec2 CellGrid::high(const Square& square) const
{
  const std::int64_t side = (std::int64_t(1) << square.logSide) - 1;
  const auto last = [side](std::int64_t low, std::uint64_t from, std::int64_t bound)
  { return static_cast<int>(std::min(low + static_cast<std::int64_t>(from) + side, bound)); };
  return { last(box_.low.x, square.x, box_.high.x), last(box_.low.y, square.y, box_.high.y) };
}

} // namespace pointfront
