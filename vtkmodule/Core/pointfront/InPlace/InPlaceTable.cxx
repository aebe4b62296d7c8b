#include "pointfront/InPlace/InPlaceTable.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/InPlace/LeafSplats.h"
#include "pointfront/InPlace/RunLedger.h"
#include "pointfront/Store/GridBounds.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Trees/BuiltTree.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <limits>

namespace pointfront
{
namespace
{
constexpr std::uint64_t blockPoints = 65536;
/// As in every store: a child must be finer than what its parent shows.
constexpr float spacingFall = 0.75f;
constexpr double countingWeight = 0.3;
constexpr double findingWeight = 0.4;

using Released = std::function<void(std::uint64_t, std::uint64_t)>;

/// Hands out the blocks of a file to threads, and lets them in again one by one in that order.
class BlockQueue
{
public:
  explicit BlockQueue(std::uint64_t points)
    : points_(points)
  {
  }
  /// False when all blocks are given away.
  bool take(std::uint64_t& begin, std::uint64_t& end)
  {
    begin = next_.fetch_add(1) * blockPoints;
    end = std::min(begin + blockPoints, points_);
    return begin < points_;
  }
  /// Waits until every earlier block has left. False if the work was stopped meanwhile.
  bool enter(std::uint64_t begin, const WorkCrew& crew)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    while (turn_ != begin && !crew.stopped())
    {
      // The crew wakes nobody when it stops.
      changed_.wait_for(lock, std::chrono::milliseconds(50));
    }
    return turn_ == begin && !crew.stopped();
  }
  void leave(std::uint64_t end)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      turn_ = end;
    }
    changed_.notify_all();
  }

private:
  std::uint64_t points_;
  std::atomic<std::uint64_t> next_{ 0 };
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t turn_ = 0;
};

Result<void> countCells(CellGrid& cells, const GridRecords& records, std::uint32_t leafPoints,
  WorkCrew& crew, const Released& released)
{
  double weight = countingWeight;
  do
  {
    crew.beginPhase("counting", records.count, weight);
    BlockQueue blocks(records.count);
    Result<void> done = crew.run(
      [&]() -> Result<void>
      {
        for (std::uint64_t begin = 0, end = 0; !crew.stopped() && blocks.take(begin, end);)
        {
          cells.count(records, begin, end);
          released(begin, end);
          crew.advance(end - begin);
        }
        return {};
      });
    if (!done)
    {
      return done;
    }
    weight = 0.0; // few files need these passes
  } while (cells.refine(leafPoints));
  return {};
}

Result<void> findRuns(const QuadTree& tree, const CellGrid& cells, const GridRecords& records,
  RunLedger& ledger, WorkCrew& crew, const Released& released)
{
  crew.beginPhase("indexing", records.count, findingWeight);
  const RunFinder finder(records, cells, tree);
  const SampleFinder sampler(tree);
  BlockQueue blocks(records.count);
  return crew.run(
    [&]() -> Result<void>
    {
      RunBatch batch;
      for (std::uint64_t begin = 0, end = 0; !crew.stopped() && blocks.take(begin, end);)
      {
        batch.runs.clear();
        finder.find(begin, end, batch.runs);
        sampler.find(batch);
        if (!blocks.enter(begin, crew))
        {
          break;
        }
        Result<void> entered = ledger.add(batch);
        blocks.leave(end);
        if (!entered)
        {
          return entered;
        }
        released(begin, end);
        crew.advance(end - begin);
      }
      return {};
    });
}

Result<void> checkPoints(const QuadTree& tree, const RunLedger& ledger, std::uint64_t count)
{
  std::uint64_t sum = 0;
  bool changed = false;
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i)
  {
    const std::uint64_t points = ledger.entries()[i].points;
    if (points > maxNodePoints)
    {
      return makeError(Error::Kind::Unsupported,
        "more than " + std::to_string(maxNodePoints) +
          " points would fall into one node; give a smaller --node-points, or build a store");
    }
    sum += points;
    changed = changed || (tree.nodes()[i].leaf() && ledger.entries()[i].box.empty());
  }
  if (changed || sum != count)
  {
    return makeError(Error::Kind::Corrupt,
      "the points changed while they were indexed; index again when nobody writes to the file");
  }
  return {};
}

void fillBranch(
  const QuadTree& tree, const RunLedger& ledger, const QuantisationGrid& grid, InPlaceTable& table)
{
  const std::vector<QuadNode>& shape = tree.nodes();
  for (NodeIndex i = static_cast<NodeIndex>(shape.size()); i-- > 0;)
  {
    Node& node = table.nodes[i];
    RecordBox box = ledger.entries()[i].box;
    node.pointsBelow = node.pointCount;
    Bounds bounds;
    for (NodeIndex child = 0; child < node.childCount; ++child)
    {
      const Node& below = table.nodes[node.firstChild + child];
      node.pointsBelow += below.pointsBelow;
      bounds.add(below.box());
      box.add(glm::ivec3(table.rows[node.firstChild + child].low));
    }
    table.rows[i].low = box.low;
    if (shape[i].leaf())
    {
      bounds = GridBounds{ GridPosition(box.low), GridPosition(box.high) }.toWorld(grid);
    }
    encloseBox(node, bounds);
  }
}

InPlaceTable tableOf(const QuadTree& tree, const RunLedger& ledger, const QuantisationGrid& grid)
{
  InPlaceTable table;
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i)
  {
    const QuadNode& from = tree.nodes()[i];
    Node node;
    node.pointCount = static_cast<std::uint32_t>(ledger.entries()[i].points);
    node.parent = from.parent;
    node.firstChild = from.firstChild;
    node.childCount = from.childCount;
    node.level = from.level;
    table.nodes.push_back(node);
    InPlaceRow row;
    row.logStep = from.logStep;
    row.pages =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(ledger.entries()[i].pages, UINT32_MAX));
    table.rows.push_back(row);
  }
  fillBranch(tree, ledger, grid, table);
  table.spilledBytes = ledger.spilledBytes();
  return table;
}

void fillSpacing(const LeafSplats& splats, std::vector<Node>& nodes)
{
  for (NodeIndex i = 0; i < nodes.size(); ++i)
  {
    Node& node = nodes[i];
    node.spacing = static_cast<float>(splats.spacing(i));
    if (node.parent != noNode)
    {
      node.spacing = std::min(node.spacing, spacingFall * nodes[node.parent].spacing);
    }
  }
}
} // namespace

std::vector<std::uint8_t> stepsAbove(const InPlaceTable& table, NodeIndex node)
{
  std::vector<std::uint8_t> steps;
  for (NodeIndex above = table.nodes[node].parent; above != noNode;
       above = table.nodes[above].parent)
  {
    const std::uint8_t step = table.rows[above].logStep;
    if (!steps.empty() && steps.back() == step)
    {
      steps.pop_back(); // the higher of two with the same step holds its points
    }
    steps.push_back(step);
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

Result<InPlaceTable> indexInPlace(const GridRecords& records, const RecordBox& box,
  const QuantisationGrid& grid, const InPlaceOptions& options, WorkCrew& crew,
  const Released& released, const RunListSink& sink)
{
  CellGrid cells(box, CellGrid::topBitsFor(records.count));
  if (Result<void> done = countCells(cells, records, options.leafPoints, crew, released); !done)
  {
    return done.error();
  }
  const QuadTree tree(cells, options.leafPoints);
  tree.assignCells(cells);
  RunLedger ledger(tree, records, options.memoryBytes, options.temporaryFolder);
  if (Result<void> done = findRuns(tree, cells, records, ledger, crew, released); !done)
  {
    return done.error();
  }
  if (Result<void> sound = checkPoints(tree, ledger, records.count); !sound)
  {
    return sound.error();
  }
  InPlaceTable table = tableOf(tree, ledger, grid);
  LeafSplats splats(tree, records, grid, released);
  Result<void> written = ledger.write(
    [&](NodeIndex i, const std::vector<std::byte>& list) -> Result<void>
    {
      if (list.size() > UINT32_MAX)
      {
        return makeError(Error::Kind::Unsupported, "a node's list of runs exceeds 4 GiB");
      }
      const Result<std::uint64_t> offset = sink(table, i, list);
      if (!offset)
      {
        return offset.error();
      }
      splats.look(i, list);
      table.rows[i].offset = *offset;
      table.rows[i].bytes = static_cast<std::uint32_t>(list.size());
      table.rows[i].checksum = checksumOf(list.data(), list.size());
      table.leafRuns += tree.nodes()[i].leaf() ? ledger.entries()[i].list.runCount() : 0;
      return {};
    });
  if (!written)
  {
    return written.error();
  }
  splats.finish();
  fillSpacing(splats, table.nodes);
  splats.fill(table.nodes);
  return table;
}

} // namespace pointfront
