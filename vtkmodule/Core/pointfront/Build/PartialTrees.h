#pragma once

#include "pointfront/Build/BuildWatch.h"
#include "pointfront/Build/TreeConstruction.h"
#include "pointfront/Trees/NodeEmitter.h"
#include "pointfront/Trees/TreeAssembly.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The parts of a build from which partial trees are made.
struct PartialTreesSite
{
  const TreeConstruction& construction;
  const NodeEmitter& emitter;
  std::size_t recordBytes = 0;
  StoreDescription description; ///< description of the store being built, without counts
};

/// The trees of a build for a watch: finished subtrees as they are, each other part built from its
/// points in a sample, and the nodes above joined from both. So a tree has points everywhere and at
/// every level, and no point twice: it leaves out points of the sample that lie in finished parts,
/// or in a place that several parts share if one of them is finished.
/// Memory   the sample's records, some times while a store is written.
/// Source   Futterlieb et al. 2016, section 3.3.1: the overview is computed again from the tree
///          (SMOOTH-1).
class PartialTrees final : public AssemblyWatch
{
public:
  /// `tree`: of the assembly. `sample`: records as in the pool.
  PartialTrees(PartialTreesSite site, std::vector<PartNode> tree,
    const std::vector<std::byte>& sample, BuildWatch& watch);

  bool due(std::size_t heldBytes) override { return watch_.due(heldBytes); }
  void show(FinishedSubtrees finished) override;

private:
  class Snapshot;
  class Weaving;
  using Trees = std::vector<std::unique_ptr<BuiltNode>>;
  struct Progress
  {
    std::vector<std::uint8_t> covered; ///< a finished subtree has that node
    std::vector<std::uint8_t> touched; ///< some part below is finished
  };
  Progress progressOf(const FinishedSubtrees& finished) const;
  std::uint64_t pointsOf(const Progress& progress) const;
  std::vector<std::vector<std::byte>> sampleOf(const Progress& progress) const;
  Result<void> write(
    FinishedSubtrees finished, const std::string& path, const MetadataRecord& record) const;

  PartialTreesSite site_;
  std::vector<PartNode> tree_;
  std::vector<std::vector<std::byte>> sample_; // for each node of tree_: records that belong there
  BuildWatch& watch_;
};

} // namespace pointfront
