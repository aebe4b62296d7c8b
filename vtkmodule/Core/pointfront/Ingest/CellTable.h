#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace pointfront
{

/// Where a cell is sought in hash tables of 2^n slots: the places of a tile of 4 x 2 x 2 cells lie
/// side by side in 16 slots, one line of the cache if a slot has four bytes. Points come along
/// lines and surfaces, so the next cell that is asked for is nearly always near the last one.
/// `salt` tells apart what has the same cell.
class CellPlace
{
public:
  static constexpr std::size_t fewestSlots = 16;

  CellPlace(const TreePosition& cell, std::uint64_t salt, std::size_t slots)
    : mask_(slots - 1)
  {
    std::uint64_t h = (std::uint64_t(cell.x >> 2) << 32 | cell.y >> 1) * 0x9e3779b97f4a7c15ull;
    h = (h ^ (h >> 32) ^ cell.z >> 1 ^ salt << 32) * 0xff51afd7ed558ccdull;
    const std::uint32_t inTile = (cell.x & 3u) + 4 * (cell.y & 1u) + 8 * (cell.z & 1u);
    slot_ = ((h >> 32) * fewestSlots + inTile) & mask_;
  }
  std::size_t slot() const { return slot_; }
  /// It is taken by another cell: the place beside the same one in the next 16 slots. Tiles stay
  /// nearly whole, and an odd step comes to every slot, whatever places cells prefer.
  void next() { slot_ = (slot_ + fewestSlots + 1) & mask_; }

private:
  std::size_t mask_;
  std::size_t slot_;
};

/// A sparse grid: a number for each cell that was touched. Cells are cubes of 2^shift steps,
/// aligned to multiples of their side, so the bounds need not be known; coordinates are modulo
/// 2^32. Memory   24 bytes a slot, at most 4 slots a cell. Threads  one instance, one thread.
class CellTable
{
public:
  struct Entry
  {
    TreePosition cell{ 0 }; ///< position >> shift
    std::uint64_t value = 0; ///< 0: the slot is free
  };

  explicit CellTable(unsigned shift);

  unsigned shift() const { return shift_; }
  std::size_t size() const { return size_; } ///< cells touched

  /// The number of that cell, made with 0. The reference holds until the next call, and the
  /// caller makes it other than 0 before that.
  std::uint64_t& at(const TreePosition& cell);
  /// The same without making it: 0 for a cell that was never touched.
  std::uint64_t find(const TreePosition& cell) const;
  TreePosition cellOf(const TreePosition& position) const
  {
    return { position.x >> shift_, position.y >> shift_, position.z >> shift_ };
  }
  std::vector<Entry> entries() const; ///< in no particular order

private:
  std::size_t slotOf(const TreePosition& cell) const;
  void grow();

  unsigned shift_;
  std::size_t size_ = 0;
  std::vector<Entry> slots_; // a power of two, linear probing
};

/// Points for each cell. Coarsens itself while it has more than `limit` cells, so its memory is
/// bounded whatever the points are.
class CellCounts
{
public:
  /// The grid of the root cube at 64 cells an edge has that many cells: a table that overflowed was
  /// too fine for it, so coarsening never goes beyond it.
  static constexpr std::size_t limit = std::size_t(1) << 18;

  explicit CellCounts(unsigned shift)
    : table_(shift)
  {
  }
  void add(const TreePosition& position, std::uint64_t count = 1);
  void add(const CellCounts& other);
  void coarsen(unsigned shift); ///< to at least that shift
  const CellTable& table() const { return table_; }

private:
  CellTable table_;
};

/// CellCounts for each object class, with cells of one size: of all classes together there are
/// not many more than CellCounts::limit.
class ClassCounts
{
public:
  explicit ClassCounts(unsigned shift, unsigned coarsest = 32)
    : shift_(shift)
    , coarsest_(coarsest)
  {
  }
  unsigned shift() const { return shift_; }
  void add(std::uint8_t objectClass, const TreePosition& position, std::uint64_t count = 1);
  void add(const ClassCounts& other);
  void coarsen(unsigned shift); ///< to at least that shift
  /// All classes as one, which gets the number 0.
  void merge();
  /// Ascending.
  const std::map<std::uint8_t, CellTable>& classes() const { return classes_; }

private:
  void fit();
  unsigned shift_;
  unsigned coarsest_; ///< cells never get larger
  std::size_t cells_ = 0;
  std::map<std::uint8_t, CellTable> classes_;
};

} // namespace pointfront
