#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ReadAhead.h"
#include "pointfront/Store/StoreWriter.h"
#include "pointfront/Threads/WorkCrew.h"
#include "pointfront/Trees/BuiltTree.h"
#include "pointfront/Trees/PartTree.h"
#include "pointfront/Trees/TreeBuilder.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace pointfront
{

/// The parts, and the builders that make nodes of them.
struct AssemblyPlan
{
  std::vector<PartNode> tree;
  /// The records of a part; from any thread.
  ReadAhead::Load load;
  ReadAheadPlan readAhead; ///< nothing for parts that are in memory
  /// Nodes around which there are so many points of the input go beside the store's tables.
  std::uint64_t lateFrom = UINT64_MAX;
  std::function<std::unique_ptr<TreeBuilder>()> builder; ///< one for each thread
};

/// A finished subtree of the upper tree. Without a parent above it is closed, its root written.
struct FinishedSubtree
{
  std::uint32_t node = 0; ///< number in the upper tree (PartTree.h)
  OpenSubtree subtree;
};

/// The finished subtrees. Their nodes are written, except the points that they still hold for the
/// nodes above.
struct FinishedSubtrees
{
  std::vector<FinishedSubtree> subtrees; ///< no one contains another; in the order of the file
  WrittenPayloads written; ///< exactly the nodes of the subtrees
};

/// An observer that sees finished subtrees while others are built.
/// Threads  called from the crew's threads, one at a time; due() with the assembly waiting.
class AssemblyWatch
{
public:
  virtual ~AssemblyWatch() = default;
  /// Whether show() is wanted now; `heldBytes`: of what the subtrees hold, which would be copied.
  virtual bool due(std::size_t heldBytes) = 0;
  virtual void show(FinishedSubtrees finished) = 0;
};

/// Builds all parts on the crew's threads, joins them upwards as soon as all children of a node
/// are there, and writes the nodes in the one order that does not depend on threads or cuts.
/// Memory   a part is begun only while few are finished ahead of the file's turn; what the roots
///          of finished parts hold is at most some nodes' worth for each level of the partition.
class TreeAssembly
{
public:
  TreeAssembly(
    AssemblyPlan plan, StoreWriter& writer, WorkCrew& crew, AssemblyWatch* watch = nullptr);

  /// The finished trees, one for each layer, with their payloads written.
  Result<std::vector<std::unique_ptr<BuiltNode>>> run();
  const SubtreeSeconds& seconds() const { return seconds_; }
  double loadSeconds() const { return loadSeconds_; } ///< CPU, over all threads
  double writeSeconds() const { return writeSeconds_; }

private:
  Result<void> work(ReadAhead& parts);
  bool takePart(std::uint32_t& node);
  Result<void> buildPart(std::uint32_t node, ReadAhead& parts, TreeBuilder& builder);
  OpenSubtree joinChildren(std::uint32_t node, TreeBuilder& builder);
  Result<void> writeInTurn();
  Result<void> letWatch(std::unique_lock<std::mutex>& lock);
  std::vector<std::uint32_t> writtenSubtrees() const;
  Result<FinishedSubtrees> finished(const std::vector<std::uint32_t>& nodes);
  void addSeconds(const TreeBuilder& builder);

  AssemblyPlan plan_;
  StoreWriter& writer_;
  WorkCrew& crew_;
  AssemblyWatch* watch_;
  std::vector<std::uint32_t> order_; // partition nodes in the order of the file
  std::vector<std::uint32_t> turns_; // place of each partition node in order_
  std::vector<std::uint32_t> partNodes_; // the parts among order_

  std::mutex mutex_; // guards what follows
  std::condition_variable turnChanged_;
  std::size_t nextPart_ = 0; // in partNodes_
  std::uint32_t turn_ = 0; // in order_: whose nodes are written next
  bool writing_ = false;
  bool watched_ = false; // watch_ is being shown something
  std::uint32_t shown_ = 0; // turn_ of what it was shown last
  std::vector<OpenSubtree> open_; // open subtree of each partition node
  std::vector<std::uint8_t> missing_; // children not finished, of each partition node
  std::map<std::uint32_t, std::vector<EmittedNode>> waiting_; // by turn
  std::vector<std::unique_ptr<BuiltNode>> roots_; // root of each layer
  SubtreeSeconds seconds_;
  double loadSeconds_ = 0.0;
  double writeSeconds_ = 0.0;
};

} // namespace pointfront
