#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/SpillFile.h"
#include "pointfront/InPlace/QuadTree.h"
#include "pointfront/InPlace/RunFinder.h"
#include "pointfront/InPlace/RunList.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A point of a run that an ancestor of its leaf holds.
struct HeldSample
{
  NodeIndex holder = noNode;
  std::uint64_t stratum = 0; ///< stratum of the holder's stream
  std::uint64_t point = 0;
};

/// The runs of a stretch of a file, and which of their points are held above their leaves.
struct RunBatch
{
  std::vector<LeafRun> runs;
  std::vector<HeldSample> samples; ///< ascending by point
  std::vector<std::size_t> sampleEnd; ///< end of run i in `samples`; it begins where i - 1 ends
};

/// Tells which points of runs are held above their leaves. Constant once made: for all threads.
class SampleFinder
{
public:
  explicit SampleFinder(const QuadTree& tree);
  /// Fills the samples of a batch whose runs are found.
  void find(RunBatch& batch) const;

private:
  /// Above a leaf, or above the slices of a sliced node.
  std::vector<std::vector<QuadTree::Holder>> holders_;
};

/// Enters runs into the lists of their nodes, in the order of the file, and counts what each node
/// holds: every point is its leaf's, or that of the one ancestor whose stream has it.
/// Memory    lists beyond `memoryBytes` go to temporary files without names; a list is put together
///           again when it is written.
/// Threads   one thread at a time.
class RunLedger
{
public:
  struct Entry
  {
    RunListWriter list;
    std::uint64_t points = 0; ///< that the node holds
    RecordBox box; ///< leaves only: of the points in its runs
    std::uint64_t pages = 0; ///< pages of 4096 bytes of the file that its points lie on
    std::uint64_t lastPage = UINT64_MAX;
  };

  RunLedger(const QuadTree& tree, const GridRecords& records, std::uint64_t memoryBytes,
    std::string temporaryFolder);

  /// Enters a batch that follows the last one in the file.
  Result<void> add(const RunBatch& batch);

  const std::vector<Entry>& entries() const { return entries_; }
  /// Hands over each node's list in the order of the nodes. Once, at the end.
  using ListSink = std::function<Result<void>(NodeIndex, const std::vector<std::byte>&)>;
  Result<void> write(const ListSink& to);
  std::uint64_t spilledBytes() const { return spilledBytes_; }

private:
  /// Lists of all nodes up to some point of the file, one behind the other.
  struct Spill
  {
    std::unique_ptr<SpillFile> file;
    std::vector<std::uint64_t> ends; ///< end of each node's bytes
  };
  void enter(const LeafRun& run, const HeldSample* samples, std::size_t sampleCount);
  void enterSlices(const LeafRun& run, const HeldSample* samples, std::size_t sampleCount);
  void enterRun(NodeIndex leaf, const Run& run, const RecordBox& box);
  void touch(Entry& entry, std::uint64_t first, std::uint64_t count);
  Result<void> spill();

  const QuadTree& tree_;
  const GridRecords& records_;
  std::uint64_t memoryBytes_;
  std::string folder_;
  std::vector<Entry> entries_;
  std::vector<std::uint64_t> slicedSoFar_; ///< points of a sliced node, by node
  std::vector<Spill> spills_;
  std::uint64_t held_ = 0; ///< bytes of lists in memory, as of the last batch
  std::uint64_t spilledBytes_ = 0;
};

} // namespace pointfront
