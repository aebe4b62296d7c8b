#pragma once

#include "TerrainPages.h"

#include "pointfront/Store/NodeReader.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace pointfront::test
{

/// Reads under way, of nodes and of pages, over all stores of a test.
struct Traffic
{
  std::atomic<int> now{ 0 };
  std::atomic<int> most{ 0 };
  void pass()
  {
    const int there = ++now;
    int before = most;
    while (before < there && !most.compare_exchange_weak(before, there))
    {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(50));
    --now;
  }
};

/// Reads wait while it is shut.
class Gate
{
public:
  void pass() const
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return isOpen_; });
  }
  void open(bool isOpen)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    isOpen_ = isOpen;
    changed_.notify_all();
  }

private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  bool isOpen_ = true;
};

/// Pages of a disk that answers only while its gate is open.
class GatedPages final : public NodePageSource
{
public:
  static constexpr int levels = 6; ///< 1,365 nodes on 23 pages

  explicit GatedPages(std::shared_ptr<Traffic> traffic)
    : pages_(levels)
    , traffic_(std::move(traffic))
  {
  }
  NodeIndex nodeCount() const override { return pages_.nodeCount(); }
  Result<void> read(std::uint32_t page, NodePage& rows) const override
  {
    gate_.pass();
    traffic_->pass();
    return pages_.read(page, rows);
  }
  void open(bool isOpen) { gate_.open(isOpen); }

private:
  TerrainPages pages_;
  std::shared_ptr<Traffic> traffic_;
  Gate gate_;
};

/// A store whose table is paged; its nodes are read at once, while their gate is open.
class TerrainReader final : public NodeReader
{
public:
  explicit TerrainReader(std::shared_ptr<Traffic> traffic, std::uint64_t disk = 0)
    : disk_(disk)
    , traffic_(std::move(traffic))
  {
    auto source = std::make_unique<GatedPages>(traffic_);
    pages = source.get();
    table = std::make_shared<PagedNodeTable>(
      std::move(source), std::vector<NodeIndex>{ 0 }, Refinement::Add);
    table->keepRoots();
  }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    nodes.pass();
    traffic_->pass();
    return FetchedNode{ node, columns, {}, 1 };
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    NodeColumns result;
    result.node = fetched.node;
    result.selection = fetched.columns;
    return result;
  }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection&) const override
  {
    return sizeof(NodeColumns);
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 1; }
  std::uint64_t disk() const override { return disk_; }
  MissingRows* missingRows() const override { return table->missingRows(); }

  std::shared_ptr<PagedNodeTable> table;
  GatedPages* pages = nullptr;
  Gate nodes;

private:
  std::uint64_t disk_;
  std::shared_ptr<Traffic> traffic_;
};

} // namespace pointfront::test
