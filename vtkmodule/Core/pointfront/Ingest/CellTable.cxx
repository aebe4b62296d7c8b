#include "pointfront/Ingest/CellTable.h"

#include <algorithm>

namespace pointfront
{

CellTable::CellTable(unsigned shift)
  : shift_(shift)
  , slots_(64)
{
}

std::size_t CellTable::slotOf(const TreePosition& cell) const
{
  CellPlace place(cell, 0, slots_.size());
  while (slots_[place.slot()].value != 0 && slots_[place.slot()].cell != cell)
  {
    place.next();
  }
  return place.slot();
}

std::uint64_t& CellTable::at(const TreePosition& cell)
{
  std::size_t slot = slotOf(cell);
  if (slots_[slot].value == 0)
  {
    if (2 * size_ >= slots_.size())
    {
      grow();
      slot = slotOf(cell);
    }
    slots_[slot].cell = cell;
    ++size_;
  }
  return slots_[slot].value;
}

std::uint64_t CellTable::find(const TreePosition& cell) const
{
  return slots_[slotOf(cell)].value;
}

void CellTable::grow()
{
  std::vector<Entry> old(2 * slots_.size());
  old.swap(slots_);
  for (const Entry& entry : old)
  {
    if (entry.value != 0)
    {
      slots_[slotOf(entry.cell)] = entry;
    }
  }
}

std::vector<CellTable::Entry> CellTable::entries() const
{
  std::vector<Entry> used;
  used.reserve(size_);
  std::copy_if(slots_.begin(), slots_.end(), std::back_inserter(used),
    [](const Entry& entry) { return entry.value != 0; });
  return used;
}

void CellCounts::add(const TreePosition& position, std::uint64_t count)
{
  table_.at(table_.cellOf(position)) += count;
  if (table_.size() > limit)
  {
    coarsen(table_.shift() + 1);
  }
}

void CellCounts::add(const CellCounts& other)
{
  coarsen(other.table_.shift());
  const unsigned otherShift = other.table_.shift();
  for (const CellTable::Entry& entry : other.table_.entries())
  {
    add({ entry.cell.x << otherShift, entry.cell.y << otherShift, entry.cell.z << otherShift },
      entry.value);
  }
}

namespace
{
CellTable twiceAsCoarse(const CellTable& table)
{
  CellTable coarse(table.shift() + 1);
  for (const CellTable::Entry& entry : table.entries())
  {
    coarse.at({ entry.cell.x >> 1, entry.cell.y >> 1, entry.cell.z >> 1 }) += entry.value;
  }
  return coarse;
}

TreePosition lowestOf(const CellTable& table, const TreePosition& cell)
{
  return { cell.x << table.shift(), cell.y << table.shift(), cell.z << table.shift() };
}
} // namespace

void CellCounts::coarsen(unsigned shift)
{
  while (table_.shift() < shift || table_.size() > limit)
  {
    table_ = twiceAsCoarse(table_);
  }
}

void ClassCounts::add(std::uint8_t objectClass, const TreePosition& position, std::uint64_t count)
{
  CellTable& table = classes_.try_emplace(objectClass, shift_).first->second;
  const std::size_t before = table.size();
  table.at(table.cellOf(position)) += count;
  cells_ += table.size() - before;
  fit();
}

void ClassCounts::fit()
{
  while (cells_ > CellCounts::limit && shift_ < coarsest_)
  {
    coarsen(shift_ + 1);
  }
}

void ClassCounts::add(const ClassCounts& other)
{
  coarsen(other.shift_);
  for (const auto& [objectClass, table] : other.classes_)
  {
    for (const CellTable::Entry& entry : table.entries())
    {
      add(objectClass, lowestOf(table, entry.cell), entry.value);
    }
  }
}

void ClassCounts::coarsen(unsigned shift)
{
  for (; shift_ < shift; ++shift_)
  {
    cells_ = 0;
    for (auto& [objectClass, table] : classes_)
    {
      table = twiceAsCoarse(table);
      cells_ += table.size();
    }
  }
}

void ClassCounts::merge()
{
  const std::map<std::uint8_t, CellTable> all = std::move(classes_);
  classes_.clear();
  cells_ = 0;
  for (const auto& [objectClass, table] : all)
  {
    for (const CellTable::Entry& entry : table.entries())
    {
      add(0, lowestOf(table, entry.cell), entry.value);
    }
  }
}

} // namespace pointfront
