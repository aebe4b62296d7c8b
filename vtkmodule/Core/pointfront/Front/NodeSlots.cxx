#include "pointfront/Front/NodeSlots.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
constexpr std::size_t firstCapacity = 64;
} // namespace

void NodeSlots::clear()
{
  std::fill(entries_.begin(), entries_.end(), Entry());
  size_ = 0;
}

/// Knuth's multiplicative hash: neighbours in the table, which are active together, spread.
std::size_t NodeSlots::home(NodeIndex node) const
{
  return (node * std::uint64_t(11400714819323198485u) >> 32) & (entries_.size() - 1);
}

void NodeSlots::insert(NodeIndex node, std::uint32_t slot)
{
  if (2 * (size_ + 1) > entries_.size())
  {
    grow();
  }
  std::size_t at = home(node);
  while (entries_[at].node != noNode)
  {
    assert(entries_[at].node != node);
    at = next(at);
  }
  entries_[at] = { node, slot };
  ++size_;
}

void NodeSlots::erase(NodeIndex node)
{
  std::size_t hole = home(node);
  while (entries_[hole].node != node)
  {
    assert(entries_[hole].node != noNode);
    hole = next(hole);
  }
  // Entries that follow without a gap move up, unless that would put one before its home.
  for (std::size_t at = next(hole); entries_[at].node != noNode; at = next(at))
  {
    const std::size_t mask = entries_.size() - 1;
    const std::size_t fromHome = (at - home(entries_[at].node)) & mask;
    const std::size_t fromHole = (at - hole) & mask;
    if (fromHome >= fromHole)
    {
      entries_[hole] = entries_[at];
      hole = at;
    }
  }
  entries_[hole] = Entry();
  --size_;
}

std::uint32_t NodeSlots::find(NodeIndex node) const
{
  if (entries_.empty())
  {
    return none;
  }
  for (std::size_t at = home(node); entries_[at].node != noNode; at = next(at))
  {
    if (entries_[at].node == node)
    {
      return entries_[at].slot;
    }
  }
  return none;
}

void NodeSlots::grow()
{
  std::vector<Entry> before(std::max(firstCapacity, 2 * entries_.size()));
  before.swap(entries_);
  size_ = 0;
  for (const Entry& entry : before)
  {
    if (entry.node != noNode)
    {
      insert(entry.node, entry.slot);
    }
  }
}

} // namespace pointfront
