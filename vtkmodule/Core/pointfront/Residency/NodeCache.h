#pragma once

#include "pointfront/Residency/MemoryBudget.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

namespace pointfront
{

/// The state of a node that was ever asked for.
struct CachedNode
{
  std::shared_ptr<const NodeColumns> points; ///< null: not in memory
  std::size_t bytes = 0; ///< bytes of `points` on the account
  bool loading = false; ///< a loader is reading it; `points` are then those it replaces
  bool stale = false; ///< lacks a column that is wanted now; waits to be read again
  bool drawn = false; ///< stale, and was asked for since
  bool failed = false;
  bool tooLarge = false; ///< failed because it does not fit the whole budget
};

/// The nodes of a store that are in memory or were asked for, and their account.
/// Threads  none of its own: the owner locks. Pointers that come out may be dropped anywhere.
class NodeCache
{
public:
  using Distance = std::function<std::uint32_t(NodeIndex)>;

  explicit NodeCache(std::shared_ptr<MemoryBudget> budget)
    : budget_(std::move(budget))
  {
  }

  CachedNode& operator[](NodeIndex node) { return nodes_[node]; }
  /// The state of a node; null if it was never asked for.
  const CachedNode* find(NodeIndex node) const;
  CachedNode* find(NodeIndex node);
  void forget(NodeIndex node) { nodes_.erase(node); }

  /// Puts points in, which are on the account with `bytes`; they leave it when the last
  /// pointer to them goes. What they replace goes first.
  void insert(NodeIndex node, NodeColumns points, std::size_t bytes);
  /// Takes a node's points out.
  std::shared_ptr<const NodeColumns> remove(NodeIndex node);

  /// Bytes of the nodes in here, without those that were taken out and are held elsewhere.
  std::size_t bytes() const { return bytes_; }
  std::uint32_t count() const { return count_; }

  template <typename Function>
  void forEach(Function function)
  {
    for (auto& [node, cached] : nodes_)
    {
      function(node, cached);
    }
  }
  template <typename Function>
  void forEach(Function function) const
  {
    for (const auto& [node, cached] : nodes_)
    {
      function(node, cached);
    }
  }

private:
  std::shared_ptr<MemoryBudget> budget_;
  std::unordered_map<NodeIndex, CachedNode> nodes_;
  std::size_t bytes_ = 0;
  std::uint32_t count_ = 0;
};

} // namespace pointfront
