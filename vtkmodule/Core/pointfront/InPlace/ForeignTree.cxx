#include "pointfront/InPlace/ForeignTree.h"

#include "pointfront/InPlace/FairOrder.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Threads/ThreadCrew.h"

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

/// In each component.
bool hasOneValue(const ColumnRange& range)
{
  return std::all_of(range.components.begin(), range.components.end(),
    [](const std::array<double, 2>& component) { return component[0] >= component[1]; });
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
  Result<std::shared_ptr<ForeignTable>> table = ForeignTable::make(content, margin);
  if (!table)
  {
    return table.error();
  }
  std::shared_ptr<ForeignTree> tree(new ForeignTree);
  tree->reader_ = content.reader;
  tree->table_ = std::move(*table);
  tree->hierarchy_ = tree->table_;
  tree->describe(content);
  const Result<void> looked = tree->lookAtFirstPoints();
  tree->cutBoxes(content.source.declaredBounds, margin);
  return looked ? Result<std::shared_ptr<const StoredCloud>>(std::move(tree)) : looked.error();
}

/// Down to the box that the file declares, if the points that were looked at keep to it.
void ForeignTree::cutBoxes(const Bounds& declared, const glm::dvec3& margin)
{
  if (!declared.empty() && encloses(grown(declared, margin), description_.bounds))
  {
    table_->cutTo(grown(declared, margin));
    description_.bounds = declared;
  }
  else if (!table_->firstRows().empty())
  {
    description_.bounds = table_->firstRows().front().row.box();
  }
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
  description_.levels = table_->levels();
  const std::vector<ForeignRow>& rows = table_->firstRows();
  const std::uint64_t points = !table_->whole() ? description_.wholeCount
    : rows.empty()                              ? 0
                                                : rows.front().row.pointsBelow;
  const auto nodes = static_cast<std::uint32_t>(table_->whole() ? rows.size() : 0);
  description_.layers = { { 0, "all", points, nodes } };
  description_.pointCount = points;
  for (const Attribute& attribute : source.schema)
  {
    description_.ranges.push_back(emptyRange(attribute));
  }
}

/// Their bounds become those of the cloud, for the time being.
Result<void> ForeignTree::lookAtFirstPoints()
{
  description_.rangesAreSampled = true;
  const std::vector<ForeignRow>& rows = table_->firstRows();
  std::vector<NodeIndex> looked;
  constexpr std::size_t most = 8;
  std::vector<ForeignNode> nodes;
  for (NodeIndex i = 0; i < rows.size() && looked.size() < most; ++i)
  {
    if (!looked.empty() && rows[i].row.level > nodes.front().level)
    {
      break;
    }
    if (rows[i].row.pointCount > 0)
    {
      looked.push_back(i);
      nodes.push_back(rows[i].cell);
    }
  }
  const ReadStop never{ false };
  std::vector<Result<RawBytes>> bytes = reader_->fetchAll(nodes, never);
  const ColumnSelection all = allColumns();
  for (std::size_t n = 0; n < looked.size(); ++n)
  {
    if (!bytes[n])
    {
      return bytes[n].error();
    }
    PointBatch batch;
    const ForeignNodes::Part part{ nodes[n], std::min(mostLookedAt, nodes[n].points), all };
    if (Result<void> decoded = reader_->decode(part, *bytes[n], batch); !decoded)
    {
      return decoded;
    }
    addRanges(batch, all);
    for (const GridPosition& step : stepsOf(batch, description_.grid))
    {
      description_.bounds.add(description_.grid.toWorld(step));
    }
  }
  lookForColours(nodes, bytes);
  if (!looked.empty())
  {
    first_ = looked.front();
    firstBytes_ = reader_->readCost().far() ? std::move(*bytes.front()) : RawBytes();
  }
  return {};
}

/// The first points of a node may lie side by side and be of one class or black, and the others
/// not: columns that decide about colours are looked at as a whole where they seem to have one
/// value.
void ForeignTree::lookForColours(
  const std::vector<ForeignNode>& nodes, const std::vector<Result<RawBytes>>& bytes)
{
  ColumnSelection same;
  for (const char* name : { "rgb", "classification", "intensity" }) // the first that varies decides
  {
    const std::optional<std::size_t> column = description_.schema.find(name);
    if (column && !hasOneValue(description_.ranges[*column]))
    {
      break;
    }
    if (column)
    {
      same.push_back(static_cast<std::uint32_t>(*column));
    }
  }
  for (std::size_t n = 0; n < nodes.size() && !same.empty(); ++n)
  {
    PointBatch batch;
    // Whoever reads a damaged column is told so; others need not care.
    if (nodes[n].points > mostLookedAt &&
      reader_->decode({ nodes[n], nodes[n].points, same }, *bytes[n], batch))
    {
      addRanges(batch, same);
    }
  }
}

void ForeignTree::addRanges(const PointBatch& batch, const ColumnSelection& columns)
{
  for (const std::uint32_t column : columns)
  {
    addRange(description_.ranges[column],
      rangeOf(batch.columns[column].data(), description_.schema[column], batch.size()));
  }
}

ColumnSelection ForeignTree::allColumns() const
{
  ColumnSelection all(description_.schema.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

Error ForeignTree::damaged(NodeIndex node, const std::string& what) const
{
  return makeError(Error::Kind::Corrupt,
    "'" + description_.path + "': node " + std::to_string(node) + " of its octree " + what +
      "; build a store from the file, which does not need its tree");
}

/// The error of a node whose page is lost, or of a number that no node has.
Error ForeignTree::lost(NodeIndex node) const
{
  const std::optional<Error> fault = table_->fault();
  return fault ? *fault : damaged(node, "is not known");
}

std::size_t ForeignTree::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, description_.schema);
}

std::size_t ForeignTree::storedBytes(NodeIndex node, const ColumnSelection&) const
{
  const std::optional<ForeignRow> found = table_->find(node);
  return found && found->cell.points > 0 ? reader_->storedBytes(found->cell) : 0;
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
  std::vector<ForeignNode> nodes;
  std::vector<std::size_t> places; ///< in `wanted`, of the nodes
  for (const auto& [node, columns] : wanted)
  {
    assert(node < hierarchy_->nodeCount());
    const std::optional<ForeignRow> found = table_->find(node);
    if (!found)
    {
      results.emplace_back(lost(node));
      continue;
    }
    FetchedNode fetched{ node, columns, {}, 0, found->row };
    if (node == first_ && firstBytes_.size > 0)
    {
      fetched.runs.emplace_back(firstBytes_.size);
      std::copy_n(firstBytes_.data.get(), firstBytes_.size, fetched.runs[0].data.get());
    }
    else if (fetched.row.pointCount > 0)
    {
      nodes.push_back(found->cell);
      places.push_back(results.size());
    }
    results.push_back(std::move(fetched));
  }
  std::vector<Result<RawBytes>> bytes = reader_->fetchAll(nodes, stop);
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

std::optional<std::uint64_t> ForeignTree::place(NodeIndex node) const
{
  const std::optional<ForeignRow> found = table_->find(node);
  return found ? reader_->place(found->cell) : std::nullopt;
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
  const std::optional<ForeignRow> found = table_->find(fetched.node); // its page is here
  if (!found)
  {
    return lost(fetched.node);
  }
  PointBatch batch;
  if (Result<void> done =
        reader_->decode({ found->cell, points, fetched.columns }, fetched.runs[0], batch);
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
  const auto begin = std::chrono::steady_clock::now();
  VerifyReport report;
  if (const Result<void> read = table_->readAll(); !read)
  {
    if (read.error().kind == Error::Kind::Cancelled)
    {
      return read.error();
    }
    report.ok = false;
    report.firstError = read.error().what;
  }
  const std::vector<NodeIndex> nodes = table_->nodes();
  const ColumnSelection all = allColumns();
  constexpr std::size_t atOnce = 64;
  for (std::size_t first = 0; first < nodes.size() && report.ok; first += atOnce)
  {
    const std::size_t count = std::min(atOnce, nodes.size() - first);
    std::vector<std::string> faults(count);
    ThreadCrew::ofProcess().run(count,
      [&](std::size_t i, unsigned)
      {
        const Result<NodeColumns> node = read(nodes[first + i], all);
        faults[i] = node ? "" : node.error().what;
      });
    for (std::size_t i = 0; i < count && report.ok; ++i)
    {
      report.ok = faults[i].empty();
      report.firstError = faults[i];
      report.nodesChecked += report.ok ? 1 : 0;
      report.pointsChecked += report.ok ? hierarchy_->node(nodes[first + i]).pointCount : 0;
    }
    Progress state{ "verifying", first + count, nodes.size(), 1.0, 0.0 };
    state.fraction = static_cast<double>(first + count) / static_cast<double>(nodes.size());
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
