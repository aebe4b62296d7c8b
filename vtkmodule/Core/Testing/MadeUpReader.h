#pragma once

#include "pointfront/Store/NodeReader.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointfront::test
{

/// Nodes without a file: node n has pointsOf(n) points in a row that begins at (n, n, n); each
/// column holds a byte a point. Reads can be held at a gate, fail, or throw.
class MadeUpReader final : public NodeReader
{
public:
  explicit MadeUpReader(std::size_t points = 100)
    : points_(points)
  {
  }

  /// Here are the gate and the failures.
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      order_.push_back(node);
      ++waiting_;
      changed_.notify_all();
      changed_.wait(lock, [&] { return open_ || tickets_ > 0; });
      tickets_ -= open_ ? 0 : 1;
      --waiting_;
      changed_.notify_all();
      if (broken_.count(node) > 0)
      {
        return makeError(Error::Kind::Corrupt, "node " + std::to_string(node) + ": made to fail");
      }
      if (throwing_.count(node) > 0)
      {
        throw std::runtime_error("made to throw");
      }
    }
    return FetchedNode{ node, columns, {}, storedBytes(node, columns) };
  }

  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    const NodeIndex node = fetched.node;
    const ColumnSelection& columns = fetched.columns;
    NodeColumns result;
    result.node = node;
    result.origin = GridPosition(node);
    result.positions.resize(pointsOf(node));
    for (std::size_t p = 0; p < result.positions.size(); ++p)
    {
      result.positions[p] = glm::u32vec3(std::uint32_t(p));
    }
    result.selection = columns;
    for (const std::uint32_t column : columns)
    {
      result.columns.emplace_back(result.positions.size(), std::byte(column));
    }
    return result;
  }

  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t, const ColumnSelection& columns) const override
  {
    return promised != 0 ? promised : trueBytes(node, columns);
  }
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override
  {
    return pointsOf(node) * (3 + columns.size());
  }

  std::uint64_t disk() const override { return diskNumber; }

  std::size_t pointsOf(NodeIndex node) const { return points_ + node % 7 * varyBy; }
  std::size_t trueBytes(NodeIndex node, const ColumnSelection& columns) const
  {
    return sizeof(NodeColumns) + pointsOf(node) * (sizeof(glm::u32vec3) + columns.size()) +
      columns.size() * sizeof(std::vector<std::byte>);
  }

  void breakNode(NodeIndex node)
  {
    locked([&] { broken_.insert(node); });
  }
  void mendNode(NodeIndex node)
  {
    locked([&] { broken_.erase(node); });
  }
  void throwAt(NodeIndex node)
  {
    locked([&] { throwing_.insert(node); });
  }
  void closeGate()
  {
    locked([&] { open_ = false; });
  }
  void openGate()
  {
    locked([&] { open_ = true; });
  }
  void letThrough(int reads)
  {
    locked([&] { tickets_ += reads; });
  }
  /// Blocks until that many reads stand at the gate.
  void awaitReads(int reads) const
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= reads; });
  }
  /// Nodes in the order in which their reads began.
  std::vector<NodeIndex> order() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return order_;
  }

  std::uint64_t diskNumber = 0;
  std::size_t promised = 0; ///< answer of decodedBytes(), if not the truth
  std::size_t varyBy = 0; ///< points more in nodes 1 to 6 of each seven

private:
  template <typename Function>
  void locked(Function function)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    function();
    changed_.notify_all();
  }

  std::size_t points_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable std::vector<NodeIndex> order_;
  mutable int waiting_ = 0;
  mutable int tickets_ = 0;
  bool open_ = true;
  std::set<NodeIndex> broken_;
  std::set<NodeIndex> throwing_;
};

} // namespace pointfront::test
