#include "pointfront/Trees/KdPool.h"

#include "pointfront/Base/CpuClock.h"

#include <algorithm>
#include <array>
#include <functional>

namespace pointfront
{
namespace
{
/// A cell with more points than an 8th of a part makes for crooked borders.
constexpr std::uint64_t clumpsAPart = 8;

std::uint64_t largestCount(const ClassCounts& counts)
{
  std::uint64_t largest = 0;
  for (const auto& [objectClass, table] : counts.classes())
  {
    for (const CellTable::Entry& entry : table.entries())
    {
      largest = std::max(largest, entry.value);
    }
  }
  return largest;
}

std::size_t cellsOf(const ClassCounts& counts)
{
  std::size_t cells = 0;
  for (const auto& [objectClass, table] : counts.classes())
  {
    cells += table.size();
  }
  return cells;
}

using Digits = std::vector<std::uint64_t>; // how many values have each 16 bits

/// A position by 16 bits at a time, coordinate after coordinate from that of the cut's axis on.
using CutKey = std::array<std::uint16_t, 6>;

struct CutOrder
{
  const TreeSpace& space;
  int axis = 0;

  CutKey keyOf(const std::byte* record) const
  {
    const TreePosition position = space.relativeSteps(positionOf(record));
    CutKey key;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::uint32_t v = position[(axis + static_cast<int>(i)) % 3];
      key[2 * i] = static_cast<std::uint16_t>(v >> 16);
      key[2 * i + 1] = static_cast<std::uint16_t>(v & 0xffffu);
    }
    return key;
  }
};

std::uint32_t digitAt(const Digits& digits, std::uint64_t& nth)
{
  std::uint32_t digit = 0;
  while (nth >= digits[digit])
  {
    nth -= digits[digit++];
  }
  return digit;
}
} // namespace

/// Cells whose size depends on the points only: not on declared bounds, nor on who counted.
Result<ClassCounts> KdPool::settled(
  const PoolPreparation& points, ClassCounts counts, unsigned hintedShift, std::uint64_t clump)
{
  const auto below = [&](unsigned bits)
  { return points.rootLog2 > bits ? points.rootLog2 - bits : 0u; };
  const unsigned finest = below(histogramCellsLog2);
  const unsigned coarsest = below(rootCellsLog2);
  if (counts.shift() > coarsest || (counts.shift() == hintedShift && counts.shift() > finest))
  {
    auto again = sorter_.count(points, finest, coarsest);
    if (!again)
    {
      return again;
    }
    counts = std::move(*again);
  }
  counts.coarsen(finest);
  // A few dense places far apart: as fine as so many cells allow.
  if (counts.shift() > 0 && 2 * cellsOf(counts) < CellCounts::limit && largestCount(counts) > clump)
  {
    return sorter_.count(points, 0, coarsest);
  }
  return counts;
}

Result<void> KdPool::build(
  const PoolPreparation& points, ClassCounts counts, unsigned hintedShift, const KdRule& rule)
{
  points_ = &points;
  auto settledCounts =
    settled(points, std::move(counts), hintedShift, rule.partPoints() / clumpsAPart);
  if (!settledCounts)
  {
    return settledCounts.error();
  }
  BucketTables buckets;
  {
    const CpuStopwatch watch(seconds_);
    std::vector<std::vector<CountedCell>> cells;
    std::vector<std::size_t> firstPlace;
    for (const auto& [objectClass, table] : settledCounts->classes())
    {
      cells.push_back(countedCells(table, points.space));
      firstPlace.push_back(places_.size());
      std::vector<KdCell> histogram;
      for (const CountedCell& cell : cells.back())
      {
        histogram.push_back({ cell.origin, cell.count });
      }
      append(
        KdCut(histogram, rule, static_cast<std::uint16_t>(cells.size() - 1)), cells.back().size());
    }
    for (std::size_t layer = 0; layer < cells.size(); ++layer)
    {
      buckets.push_back(bucketTable(cells[layer], settledCounts->shift(), firstPlace[layer]));
    }
  }
  const auto parts = static_cast<std::uint32_t>(counts_.size());
  auto pieces = sorter_.sort(points, buckets, parts + static_cast<std::uint32_t>(divided_.size()));
  if (!pieces)
  {
    return pieces.error();
  }
  pieces_.assign(pieces->begin(), pieces->begin() + parts);
  if (points.findable)
  {
    layers_ = points.layers;
    buckets_ = std::move(buckets);
  }
  const CpuStopwatch watch(seconds_);
  for (std::size_t i = 0; i < divided_.size() && !sorter_.crew().stopped(); ++i)
  {
    if (Result<void> done = distribute(divided_[i], std::move((*pieces)[parts + i])); !done)
    {
      return done;
    }
  }
  return sorter_.crew().outcome();
}

void KdPool::append(const KdCut& cut, std::size_t cells)
{
  const auto firstNode = static_cast<std::uint32_t>(tree_.size());
  const auto firstPart = static_cast<std::uint32_t>(counts_.size());
  const auto firstPlace = static_cast<std::uint32_t>(places_.size());
  for (std::size_t i = 0; i < cut.tree().size(); ++i)
  {
    PartNode node = cut.tree()[i];
    if (node.part != PartNode::none)
    {
      counts_.push_back(node.count);
      node.part += firstPart;
      nodeOfPart_.push_back(static_cast<std::uint32_t>(tree_.size()));
    }
    node.parent += node.parent != PartNode::none ? firstNode : 0;
    for (std::uint32_t& child : node.children)
    {
      child += firstNode;
    }
    tree_.push_back(std::move(node));
    shares_.push_back(cut.shares()[i]);
    for (KdShare& share : shares_.back())
    {
      share.node += firstNode;
    }
  }
  for (std::size_t i = 0; i < cut.places().size(); ++i)
  {
    KdPlace place = cut.places()[i];
    place.part += place.part != KdPlace::none ? firstPart : 0;
    place.left += place.left != KdPlace::none ? firstPlace : 0;
    place.right += place.right != KdPlace::none ? firstPlace : 0;
    places_.push_back(place);
    if (i < cells && place.part == KdPlace::none)
    {
      divided_.push_back(firstPlace + static_cast<std::uint32_t>(i));
    }
  }
}

/// Each part has a bucket, and behind these each divided cell has one.
CellTable KdPool::bucketTable(
  const std::vector<CountedCell>& cells, unsigned shift, std::size_t firstPlace) const
{
  CellTable table(shift);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const auto place = static_cast<std::uint32_t>(firstPlace + i);
    const auto nth = std::lower_bound(divided_.begin(), divided_.end(), place) - divided_.begin();
    const std::uint64_t bucket = places_[place].part != KdPlace::none
      ? places_[place].part
      : counts_.size() + static_cast<std::uint64_t>(nth);
    table.at(table.cellOf(cells[i].origin)) = bucket + 1;
  }
  return table;
}

std::uint32_t KdPool::nodeOf(const std::byte* record) const
{
  const CellTable& table = buckets_[layers_.layerOf(record)];
  const std::uint64_t bucket = table.find(table.cellOf(positionOf(record))); // plus one
  if (bucket == 0)
  {
    return PartNode::none;
  }
  return bucket <= counts_.size() ? nodeOfPart_[bucket - 1]
                                  : nodeOfPlace(divided_[bucket - 1 - counts_.size()]);
}

std::uint32_t KdPool::nodeOfPlace(std::uint32_t place) const
{
  if (places_[place].part != KdPlace::none)
  {
    return nodeOfPart_[places_[place].part];
  }
  std::uint32_t a = nodeOfPlace(places_[place].left);
  std::uint32_t b = nodeOfPlace(places_[place].right);
  while (a != b) // parents come before their children
  {
    std::uint32_t& lower = a > b ? a : b;
    lower = tree_[lower].parent;
  }
  return a;
}

Result<void> KdPool::distribute(std::uint32_t place, std::vector<Piece> pieces)
{
  const KdPlace& to = places_[place];
  if (to.part != KdPlace::none)
  {
    std::vector<Piece>& part = pieces_[to.part];
    part.insert(part.end(), pieces.begin(), pieces.end());
    return {};
  }
  std::vector<Piece> left;
  std::vector<Piece> right;
  if (Result<void> done = divide(to, pieces, left, right); !done)
  {
    return done;
  }
  pieces.clear();
  if (Result<void> done = distribute(to.left, std::move(left)); !done)
  {
    return done;
  }
  return distribute(to.right, std::move(right));
}

/// By counting 16 bits at a time, so that a cell of any number of points is divided in the memory
/// of a block. Points are in the order of their coordinates, that of the cut's axis first: those
/// before the nth position go to the left, of those at it the first in input order.
Result<void> KdPool::divide(const KdPlace& place, const std::vector<Piece>& pieces,
  std::vector<Piece>& left, std::vector<Piece>& right)
{
  RunSorter sorter(sorter_.pool(), sorter_.recordBytes());
  const CutOrder order{ points_->space, place.axis };
  std::uint64_t nth = place.first;
  CutKey key{};
  for (std::size_t digit = 0; digit < key.size() && (digit == 0 || nth > 0); ++digit)
  {
    Digits digits(1u << 16, 0);
    for (const Piece& piece : pieces)
    {
      if (Result<void> done = sorter.load(piece); !done)
      {
        return done;
      }
      for (std::uint64_t i = 0; i < piece.count; ++i)
      {
        const CutKey own = order.keyOf(sorter.record(i));
        digits[own[digit]] +=
          std::equal(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(digit), own.begin())
          ? 1u
          : 0u;
      }
    }
    key[digit] = static_cast<std::uint16_t>(digitAt(digits, nth));
  }
  std::uint64_t equalToTheLeft = nth;
  const auto side = [&](const std::byte* record) -> std::uint32_t
  {
    const CutKey own = order.keyOf(record);
    if (equalToTheLeft > 0 && own == key)
    {
      --equalToTheLeft;
      return 0;
    }
    return own < key ? 0 : 1;
  };
  for (const Piece& piece : pieces)
  {
    if (Result<void> done = sorter.load(piece); !done)
    {
      return done;
    }
    auto sorted = sorter.sort(2, std::ref(side));
    if (!sorted)
    {
      return sorted.error();
    }
    for (const PartPiece& half : *sorted)
    {
      (half.part == 0 ? left : right).push_back(half.piece);
    }
  }
  return {};
}

Result<std::vector<std::byte>> KdPool::load(std::uint32_t part) const
{
  return sorter_.load(*points_, pieces_[part]);
}

} // namespace pointfront
