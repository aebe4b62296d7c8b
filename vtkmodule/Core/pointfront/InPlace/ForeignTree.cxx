#include "pointfront/InPlace/ForeignTree.h"

#include "pointfront/InPlace/ForeignTable.h"
#include "pointfront/InPlace/SampleStream.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Trees/PrefixOrder.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint32_t mostLookedAt = 1000; ///< points of a node, when the tree is opened

/// Ten bits of a number, two zeros between each and the next.
std::uint64_t spread(std::uint64_t bits)
{
  bits = (bits | bits << 16) & 0x30000ffull;
  bits = (bits | bits << 8) & 0x300f00full;
  bits = (bits | bits << 4) & 0x30c30c3ull;
  return (bits | bits << 2) & 0x9249249ull;
}

/// Numbers of the keys, by key, equal ones by number. Keys of 30 bits; three passes over the bits
/// are faster than comparing (the first picture waits for this).
std::vector<std::uint32_t> sortedByKey(const std::vector<std::uint32_t>& keys)
{
  constexpr unsigned digitBits = 10;
  constexpr std::uint32_t mask = (1u << digitBits) - 1;
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::uint32_t> next(keys.size());
  for (unsigned shift = 0; shift < 3 * digitBits; shift += digitBits)
  {
    std::array<std::uint32_t, mask + 2> begin{}; // first of each digit in `next`
    for (const std::uint32_t key : keys)
    {
      ++begin[(key >> shift & mask) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const std::uint32_t number : order)
    {
      next[begin[keys[number] >> shift & mask]++] = number;
    }
    order.swap(next);
  }
  return order;
}

/// Places of the points in an order whose every prefix is a fair subset: batches along the Morton
/// curve.
std::vector<std::uint32_t> fairOrder(
  const std::vector<GridPosition>& steps, const GridPosition& low, const GridPosition& high)
{
  constexpr unsigned bits = 10;
  const GridPosition extent = high - low;
  unsigned shift = 0;
  while ((std::max({ extent.x, extent.y, extent.z }) >> shift) >= (1 << bits))
  {
    ++shift;
  }
  std::vector<std::uint32_t> along(steps.size()); // places on the curve
  std::transform(steps.begin(), steps.end(), along.begin(),
    [&](const GridPosition& step)
    {
      const GridPosition p = step - low;
      return static_cast<std::uint32_t>(spread(std::uint64_t(p.x) >> shift) |
        spread(std::uint64_t(p.y) >> shift) << 1 | spread(std::uint64_t(p.z) >> shift) << 2);
    });
  std::vector<RankedHash> ranked;
  ranked.reserve(steps.size());
  for (const std::uint32_t point : sortedByKey(along))
  {
    ranked.push_back({ point, static_cast<std::uint32_t>(SampleStream::mixed(point) >> 32) });
  }
  return prefixBatches(std::move(ranked));
}

std::vector<GridPosition> stepsOf(const PointBatch& batch, const QuantisationGrid& grid)
{
  std::vector<GridPosition> steps;
  steps.reserve(batch.size());
  for (const glm::ivec3& step : batch.steps)
  {
    steps.emplace_back(step);
  }
  for (const glm::dvec3& position : batch.positions)
  {
    steps.push_back(grid.toGrid(position));
  }
  return steps;
}

Bounds grown(const Bounds& box, const glm::dvec3& by)
{
  return { box.low - by, box.high + by };
}

bool encloses(const Bounds& outer, const Bounds& inner)
{
  return outer.contains(inner.low) && outer.contains(inner.high);
}

std::vector<std::byte> gathered(
  const std::vector<std::byte>& values, const std::vector<std::uint32_t>& order, std::size_t bytes)
{
  std::vector<std::byte> result(order.size() * bytes);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    std::copy_n(values.data() + order[i] * bytes, bytes, result.data() + i * bytes);
  }
  return result;
}

bool finite(const glm::dvec3& p)
{
  return std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) }) <= farthestCoordinate;
}
} // namespace

Result<std::shared_ptr<const StoredCloud>> ForeignTree::make(ForeignTreeContent content)
{
  assert(content.source.grid && content.reader);
  const QuantisationGrid& grid = *content.source.grid;
  // Who cut the tree compared positions before or after they were rounded to the grid.
  const glm::dvec3 margin =
    grid.scale + (glm::abs(content.low) + glm::dvec3(std::abs(content.side))) * 0x1p-48;
  Result<ForeignTable> table = ForeignTable::make(content, margin);
  if (!table)
  {
    return table.error();
  }
  std::shared_ptr<ForeignTree> tree(new ForeignTree);
  tree->reader_ = content.reader;
  tree->describe(content);
  tree->description_.levels = table->levels;
  tree->chunks_ = table->chunks;
  const auto setTable = [&tree](std::vector<Node> nodes)
  {
    tree->description_.layers = { { 0, "all", nodes.empty() ? 0 : nodes.front().pointsBelow,
      static_cast<std::uint32_t>(nodes.size()) } };
    tree->description_.pointCount = tree->description_.layers.front().pointCount;
    std::vector<NodeIndex> roots;
    if (!nodes.empty())
    {
      roots.push_back(0);
    }
    tree->hierarchy_ =
      std::make_shared<HierarchyTable>(std::move(nodes), std::move(roots), Refinement::Add);
  };
  setTable(table->nodes);
  if (Result<void> looked = tree->lookAtFirstPoints(); !looked)
  {
    return looked.error();
  }
  const Bounds& declared = content.source.declaredBounds;
  if (!declared.empty() && encloses(grown(declared, margin), tree->description_.bounds))
  {
    table->cutTo(grown(declared, margin));
    tree->description_.bounds = declared;
    setTable(std::move(table->nodes));
  }
  else if (!table->nodes.empty())
  {
    tree->description_.bounds = table->nodes.front().box();
  }
  return std::shared_ptr<const StoredCloud>(std::move(tree));
}

void ForeignTree::describe(const ForeignTreeContent& content)
{
  const SourceDescription& source = content.source;
  description_.path = source.path;
  description_.fileBytes = content.fileBytes;
  description_.grid = *source.grid;
  description_.crsWkt = source.crsWkt;
  description_.structure = "octree";
  description_.refinement = Refinement::Add;
  description_.schema = source.schema;
  description_.metadata = source.metadata;
  description_.generator = source.format;
  description_.warnings = source.warnings;
  description_.wholeCount = source.headerPointCount.value_or(0);
  for (const Attribute& attribute : source.schema)
  {
    description_.ranges.push_back(emptyRange(attribute));
  }
}

/// Their bounds become those of the cloud, for the time being.
Result<void> ForeignTree::lookAtFirstPoints()
{
  description_.rangesAreSampled = true;
  ColumnSelection all(description_.schema.size());
  std::iota(all.begin(), all.end(), 0u);
  const Hierarchy& table = *hierarchy_;
  std::vector<NodeIndex> looked;
  constexpr std::size_t most = 8;
  std::vector<std::uint64_t> chunks;
  for (NodeIndex i = 0; i < table.nodeCount() && looked.size() < most; ++i)
  {
    const Node row = table.node(i);
    if (!looked.empty() && row.level > table.node(looked.front()).level)
    {
      break;
    }
    if (row.pointCount > 0)
    {
      looked.push_back(i);
      chunks.push_back(chunks_[i]);
    }
  }
  const ReadStop never{ false };
  std::vector<Result<RawBytes>> bytes = reader_->fetchAll(chunks, never);
  for (std::size_t n = 0; n < looked.size(); ++n)
  {
    if (!bytes[n])
    {
      return bytes[n].error();
    }
    const std::uint32_t points = table.node(looked[n]).pointCount;
    PointBatch batch;
    const ForeignNodes::Part part{ chunks[n], points, std::min(mostLookedAt, points), all };
    if (Result<void> decoded = reader_->decode(part, *bytes[n], batch); !decoded)
    {
      return decoded;
    }
    for (std::size_t c = 0; c < all.size(); ++c)
    {
      addRange(description_.ranges[c],
        rangeOf(batch.columns[c].data(), description_.schema[c], batch.size()));
    }
    for (const GridPosition& step : stepsOf(batch, description_.grid))
    {
      description_.bounds.add(description_.grid.toWorld(step));
    }
  }
  if (!looked.empty())
  {
    first_ = looked.front();
    firstBytes_ = reader_->readCost().far() ? std::move(*bytes.front()) : RawBytes();
  }
  return {};
}

Error ForeignTree::damaged(NodeIndex node, const std::string& what) const
{
  return makeError(Error::Kind::Corrupt,
    "'" + description_.path + "': node " + std::to_string(node) + " of its octree " + what +
      "; build a store from the file, which does not need its tree");
}

std::size_t ForeignTree::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, description_.schema);
}

std::size_t ForeignTree::storedBytes(NodeIndex node, const ColumnSelection&) const
{
  return hierarchy_->node(node).pointCount > 0 ? reader_->storedBytes(chunks_[node]) : 0;
}

std::vector<Result<RawBytes>> ForeignNodes::fetchAll(
  const std::vector<std::uint64_t>& chunks, const ReadStop& stop) const
{
  std::vector<Result<RawBytes>> fetched;
  for (const std::uint64_t chunk : chunks)
  {
    fetched.push_back(
      stop ? makeError(Error::Kind::Cancelled, "nobody wants this node now") : fetch(chunk));
  }
  return fetched;
}

Result<FetchedNode> ForeignTree::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  const ReadStop never{ false };
  return std::move(fetchAll({ { node, columns } }, never).front());
}

std::vector<Result<FetchedNode>> ForeignTree::fetchAll(
  const std::vector<WantedNode>& wanted, const ReadStop& stop) const
{
  std::vector<Result<FetchedNode>> results;
  std::vector<std::uint64_t> chunks;
  std::vector<std::size_t> places; ///< in `wanted`, of the chunks
  for (const auto& [node, columns] : wanted)
  {
    assert(node < hierarchy_->nodeCount());
    FetchedNode fetched{ node, columns, {}, 0, hierarchy_->node(node) };
    if (node == first_ && firstBytes_.size > 0)
    {
      fetched.runs.emplace_back(firstBytes_.size);
      std::copy_n(firstBytes_.data.get(), firstBytes_.size, fetched.runs[0].data.get());
    }
    else if (fetched.row.pointCount > 0)
    {
      chunks.push_back(chunks_[node]);
      places.push_back(results.size());
    }
    results.push_back(std::move(fetched));
  }
  std::vector<Result<RawBytes>> bytes = reader_->fetchAll(chunks, stop);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    Result<FetchedNode>& result = results[places[i]];
    if (!bytes[i])
    {
      result = bytes[i].error();
      continue;
    }
    result->bytesRead = bytes[i]->size;
    result->runs.push_back(std::move(*bytes[i]));
  }
  return results;
}

Result<NodeColumns> ForeignTree::decode(const FetchedNode& fetched) const
{
  if (fetched.node != first_)
  {
    return decodeNow(fetched);
  }
  const std::lock_guard<std::mutex> lock(mutex_); // who asks meanwhile asks for the same
  if (!kept_ || kept_->selection != fetched.columns)
  {
    Result<NodeColumns> node = decodeNow(fetched);
    if (!node)
    {
      return node;
    }
    kept_ = std::make_unique<const NodeColumns>(std::move(*node));
  }
  return *kept_;
}

Result<NodeColumns> ForeignTree::decodeNow(const FetchedNode& fetched) const
{
  const std::uint32_t points = fetched.row.pointCount;
  NodeColumns result = emptyColumns(fetched.node, points, fetched.columns, description_.schema);
  result.describe(fetched.row);
  if (points == 0)
  {
    return result;
  }
  PointBatch batch;
  if (Result<void> done = reader_->decode(
        { chunks_[fetched.node], points, points, fetched.columns }, fetched.runs[0], batch);
      !done)
  {
    return done.error();
  }
  if (batch.size() != points)
  {
    return damaged(fetched.node,
      "has " + std::to_string(batch.size()) + " points, not the " + std::to_string(points) +
        " that its hierarchy says");
  }
  if (!std::all_of(batch.positions.begin(), batch.positions.end(), finite))
  {
    return damaged(fetched.node, "has a point that is no position");
  }
  const QuantisationGrid& grid = description_.grid;
  const std::vector<GridPosition> steps = stepsOf(batch, grid);
  GridPosition low(std::numeric_limits<std::int64_t>::max());
  GridPosition high(std::numeric_limits<std::int64_t>::min());
  for (const GridPosition& step : steps)
  {
    low = glm::min(low, step);
    high = glm::max(high, step);
  }
  const GridPosition extent = high - low;
  if (!encloses(fetched.row.box(), { grid.toWorld(low), grid.toWorld(high) }) ||
    std::max({ extent.x, extent.y, extent.z }) > std::numeric_limits<std::uint32_t>::max())
  {
    return damaged(fetched.node, "has points outside of its cell");
  }
  const std::vector<std::uint32_t> order = fairOrder(steps, low, high);
  result.origin = low;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    result.positions[i] = glm::u32vec3(steps[order[i]] - low);
  }
  for (std::size_t c = 0; c < fetched.columns.size(); ++c)
  {
    const std::uint32_t column = fetched.columns[c];
    result.columns[c] = gathered(batch.columns[column], order, description_.schema[column].bytes());
  }
  return result;
}

Result<VerifyReport> ForeignTree::verify(const ProgressFunction& progress) const
{
  const NodeIndex nodes = hierarchy_->nodeCount();
  const auto begin = std::chrono::steady_clock::now();
  VerifyReport report;
  constexpr NodeIndex atOnce = 64;
  for (NodeIndex first = 0; first < nodes && report.ok; first += atOnce)
  {
    const NodeIndex count = std::min(atOnce, nodes - first);
    std::vector<std::string> faults(count);
    ThreadCrew::ofProcess().run(count,
      [&](std::size_t i, unsigned)
      {
        const Result<NodeColumns> node = read(first + static_cast<NodeIndex>(i), {});
        faults[i] = node ? "" : node.error().what;
      });
    for (NodeIndex i = 0; i < count && report.ok; ++i)
    {
      report.ok = faults[i].empty();
      report.firstError = faults[i];
      report.nodesChecked += report.ok ? 1 : 0;
      report.pointsChecked += report.ok ? hierarchy_->node(first + i).pointCount : 0;
    }
    Progress state{ "verifying", first + count, nodes, 1.0, 0.0 };
    state.fraction = static_cast<double>(first + count) / nodes;
    state.secondsElapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (progress && !progress(state))
    {
      return makeError(
        Error::Kind::Cancelled, "verifying '" + description_.path + "' was cancelled");
    }
  }
  if (report.ok && description_.missingPoints() > 0)
  {
    report.ok = false;
    report.firstError = "'" + description_.path + "': its octree lacks " +
      std::to_string(description_.missingPoints()) + " of the " +
      std::to_string(description_.wholeCount) +
      " points; build a store from the file, which does not need its tree";
  }
  return report;
}

} // namespace pointfront
