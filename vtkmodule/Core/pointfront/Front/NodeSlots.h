#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Maps active nodes to their slots. Open addressing with linear probing: one allocation that
/// doubles when it is half full, none in the steady state.
/// Threads  one.
class NodeSlots
{
public:
  static constexpr std::uint32_t none = 0xffffffffu;

  void clear();
  /// Adds a node that is not in the map.
  void insert(NodeIndex node, std::uint32_t slot);
  /// Removes a node of the map.
  void erase(NodeIndex node);
  std::uint32_t find(NodeIndex node) const;
  std::size_t size() const { return size_; }

private:
  struct Entry
  {
    NodeIndex node = noNode; ///< noNode: free
    std::uint32_t slot = none;
  };
  std::size_t home(NodeIndex node) const;
  std::size_t next(std::size_t at) const { return at + 1 < entries_.size() ? at + 1 : 0; }
  void grow();

  std::vector<Entry> entries_; ///< a power of two, or none
  std::size_t size_ = 0;
};

} // namespace pointfront
