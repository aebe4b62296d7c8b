#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Build/BuiltTree.h"
#include "pointfront/Build/NodeEmitter.h"
#include "pointfront/Build/PartPool.h"
#include "pointfront/Build/SubtreeBuilder.h"
#include "pointfront/Build/WorkCrew.h"
#include "pointfront/Store/StoreWriter.h"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace pointfront
{

/// Builds all parts on the crew's threads, joins them upwards as soon as all children of a node
/// are there, and writes the nodes in the one order that does not depend on threads or cuts.
/// Memory   a part is begun only while few are finished ahead of the file's turn; what the roots
///          of finished parts hold is at most some nodes' worth for each level of the partition.
class OctreeAssembly
{
public:
  OctreeAssembly(const PartPool& parts, const NodeEmitter& emitter, const SamplingRule& rule,
    std::size_t recordBytes, StoreWriter& writer, WorkCrew& crew);

  /// The finished tree with its payloads written; null for no points.
  Result<std::unique_ptr<BuiltNode>> run();
  const SubtreeSeconds& seconds() const { return seconds_; }
  double writeSeconds() const { return writeSeconds_; }

private:
  Result<void> work();
  bool takePart(std::uint32_t& node);
  Result<void> buildPart(std::uint32_t node, SubsetSampler& sampler);
  OpenSubtree joinChildren(std::uint32_t node, SubtreeBuilder& builder);
  Result<void> writeInTurn();
  void addSeconds(const SubtreeBuilder& builder);

  const PartPool& parts_;
  const NodeEmitter& emitter_;
  SamplingRule rule_;
  std::size_t recordBytes_;
  StoreWriter& writer_;
  WorkCrew& crew_;
  std::vector<std::uint32_t> order_;     // partition nodes in the order of the file
  std::vector<std::uint32_t> rank_;      // of each partition node in order_
  std::vector<std::uint32_t> partNodes_; // the parts among order_

  std::mutex mutex_; // guards what follows
  std::condition_variable turnChanged_;
  std::size_t nextPart_ = 0; // in partNodes_
  std::uint32_t turn_ = 0;   // in order_: whose nodes are written next
  bool writing_ = false;
  std::vector<OpenSubtree> open_;     // of each partition node
  std::vector<std::uint8_t> missing_; // children not finished, of each partition node
  std::map<std::uint32_t, std::vector<EmittedNode>> waiting_; // by rank
  std::unique_ptr<BuiltNode> root_;
  SubtreeSeconds seconds_;
  double writeSeconds_ = 0.0;
};

} // namespace pointfront
