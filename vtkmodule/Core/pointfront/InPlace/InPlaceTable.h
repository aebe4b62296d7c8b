#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/InPlace/GridRecords.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Threads/WorkCrew.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts about a node in the side file that the node table's row lacks.
struct InPlaceRow
{
  std::uint64_t offset = 0; ///< offset of its list of runs in the side file
  std::uint32_t bytes = 0; ///< size of the list
  std::uint32_t checksum = 0; ///< checksum of the list
  glm::ivec3 low{ 0 }; ///< lowest grid position of its points and of all below
  std::uint32_t pages = 0; ///< pages of 4096 bytes that its points lie on in the points' file
  std::uint8_t logStep = 0; ///< inner nodes: the list is of strata of the stream of 2^logStep
};

/// Where a node's values of one attribute lie in the side file, and how they are coded. In the
/// order of the points' numbers.
struct ValueBlock
{
  std::uint64_t offset = 0;
  std::uint32_t bytes = 0;
  std::uint32_t checksum = 0;
  BlockCodec codec = BlockCodec::Raw;
};

struct InPlaceOptions
{
  std::uint32_t leafPoints = 16384; ///< 256 to 2^20; Kovac has 5,000 for each draw call
  std::uint64_t memoryBytes = std::uint64_t(256) << 20; ///< for lists; the grid takes 64 MiB more
  std::string temporaryFolder; ///< for lists beyond memoryBytes
};

/// The in-place tree over some records: the points of each node, as runs.
/// Shapes    nodes[i] goes with rows[i]; breadth first. An inner node has the points of its runs of
///           strata, except those in a coarser stream of an ancestor. A leaf has the points of its
///           runs, except those in a stream of an ancestor. Every point is in exactly one node.
struct InPlaceTable
{
  std::vector<Node> nodes;
  std::vector<InPlaceRow> rows;
  /// Blocks of the side file's attributes: those of nodes[0], of nodes[1] ... Empty: none.
  std::vector<ValueBlock> blocks;
  std::uint64_t leafRuns = 0; ///< runs of consecutive points, over all leaves
  std::uint64_t spilledBytes = 0;
};

/// Steps of the streams that the ancestors of a node hold, coarsest first.
std::vector<std::uint8_t> stepsAbove(const InPlaceTable& table, NodeIndex node);

/// Receives each node's list, in the order of the nodes; tells where it lies. Of the table shape,
/// counts and steps are final.
using RunListSink = std::function<Result<std::uint64_t>(
  const InPlaceTable&, NodeIndex, const std::vector<std::byte>&)>;

/// Indexes records in two passes (more where cells are very dense): counts them in a grid of the
/// plane, cuts the plane into a quadtree, finds the runs. `box` is that of all records.
/// Memory    the grid (4 bytes a cell, 64 MiB at most), the lists up to options.memoryBytes, some
///           100 bytes a node, a megabyte or two a thread. Does not grow with the records.
/// Order     the result depends on the records and leafPoints only, not on threads or memory.
/// Errors    Unwritable (spill), Unsupported (a node beyond 2^24 points), Corrupt when the records
///           change while they are read, Cancelled; of the sink.
/// `released` is called with ranges of records that are not needed again soon.
Result<InPlaceTable> indexInPlace(const GridRecords& records, const RecordBox& box,
  const QuantisationGrid& grid, const InPlaceOptions& options, WorkCrew& crew,
  const std::function<void(std::uint64_t begin, std::uint64_t end)>& released,
  const RunListSink& sink);

} // namespace pointfront
