#include "pointfront/Export/StoreExport.h"

#include "pointfront/Export/ExportClock.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Points/EnclosingRadius.h"

#include <algorithm>
#include <bitset>
#include <cstring>
#include <future>
#include <optional>
#include <utility>

namespace pointfront
{

namespace
{

/// Decides about single points and copies the chosen ones.
class PointFilter
{
public:
  PointFilter(const StoreDescription& description, const ExportSelection& selection,
    std::optional<std::size_t> classColumn)
    : description_(description)
    , box_(selection.box)
    , classColumn_(classColumn)
  {
    for (const std::uint8_t code : selection.classes)
    {
      classes_.set(code);
    }
  }

  /// False if no point of the node can pass.
  bool mayPass(const Node& node) const { return !box_ || box_->overlaps(node.box()); }

  /// Fills `batch` with the node's points that pass.
  void filter(const NodeColumns& node, PointBatch& batch)
  {
    const QuantisationGrid& grid = description_.grid;
    batch.positions.clear();
    kept_.clear();
    for (std::size_t i = 0; i < node.size(); ++i)
    {
      const glm::dvec3 world = grid.toWorld(node.origin + GridPosition(node.positions[i]));
      if ((!box_ || box_->contains(world)) && classPasses(node, i))
      {
        batch.positions.push_back(world);
        kept_.push_back(static_cast<std::uint32_t>(i));
      }
    }
    batch.resize(batch.positions.size(), description_.schema);
    for (std::size_t c = 0; c < description_.schema.size(); ++c)
    {
      copyKept(node.columns[c], batch.columns[c], description_.schema[c].bytes());
    }
  }

private:
  bool classPasses(const NodeColumns& node, std::size_t point) const
  {
    return !classColumn_ ||
      classes_[std::to_integer<std::uint8_t>(node.columns[*classColumn_][point])];
  }

  void copyKept(
    const std::vector<std::byte>& from, std::vector<std::byte>& to, std::size_t bytes) const
  {
    if (kept_.size() * bytes == from.size()) // every point passed
    {
      std::copy(from.begin(), from.end(), to.begin());
      return;
    }
    for (std::size_t i = 0; i < kept_.size(); ++i)
    {
      std::memcpy(to.data() + i * bytes, from.data() + kept_[i] * bytes, bytes);
    }
  }

  const StoreDescription& description_;
  std::optional<Bounds> box_;
  std::optional<std::size_t> classColumn_; ///< set only if classes are asked for
  std::bitset<256> classes_;
  std::vector<std::uint32_t> kept_;
};

/// Nodes to decode, ascending: those at most one level finer than the wanted spacing; with mean
/// representatives only the last ones of each branch.
std::vector<NodeIndex> chosenNodes(
  const Hierarchy& hierarchy, const PointFilter& filter, double spacing)
{
  std::vector<NodeIndex> chosen;
  std::vector<NodeIndex> open(hierarchy.roots());
  while (!open.empty())
  {
    const NodeIndex index = open.back();
    open.pop_back();
    const Node node = hierarchy.node(index);
    if (!filter.mayPass(node))
    {
      continue;
    }
    const bool finer = !node.leaf() && (spacing <= 0.0 || double(node.spacing) > spacing);
    if (node.pointCount > 0 && (hierarchy.refinement() == Refinement::Add || !finer))
    {
      chosen.push_back(index);
    }
    if (finer)
    {
      hierarchy.appendChildren(index, node, open);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

SinkDescription sinkDescription(const StoreDescription& store, const ExportSelection& selection)
{
  SinkDescription sink;
  sink.schema = store.schema;
  sink.grid = store.grid;
  sink.bounds = store.bounds;
  if (selection.box)
  {
    sink.bounds.low = glm::max(sink.bounds.low, selection.box->low);
    sink.bounds.high = glm::min(sink.bounds.high, selection.box->high);
  }
  const bool everything =
    !selection.box && selection.classes.empty() && selection.spacing <= 0.0;
  sink.pointCount = everything ? store.pointCount : 0;
  for (const ColumnRange& range : store.ranges)
  {
    double largest = 0.0;
    for (const std::array<double, 2>& component : range.components)
    {
      largest = std::max(largest, component[1]);
    }
    sink.largest.push_back(largest);
  }
  sink.crsWkt = store.crsWkt;
  sink.metadata = store.metadata;
  return sink;
}

/// Decodes one node after another, always one ahead on a thread of its own. The future's
/// destructor waits for that thread, so nothing outlives the reader.
class NodeStream
{
public:
  NodeStream(const NodeReader& reader, std::vector<NodeIndex> nodes, ColumnSelection columns)
    : reader_(reader)
    , nodes_(std::move(nodes))
    , columns_(std::move(columns))
  {
    startNext();
  }
  bool atEnd() const { return !ahead_.valid(); }
  Result<NodeColumns> take()
  {
    Result<NodeColumns> node = ahead_.get();
    startNext();
    return node;
  }

private:
  void startNext()
  {
    if (started_ < nodes_.size())
    {
      const NodeIndex node = nodes_[started_++];
      ahead_ =
        std::async(std::launch::async, [this, node]() { return reader_.read(node, columns_); });
    }
  }

  const NodeReader& reader_;
  std::vector<NodeIndex> nodes_;
  ColumnSelection columns_;
  std::size_t started_ = 0;
  std::future<Result<NodeColumns>> ahead_;
};

std::uint64_t pointsOf(const Hierarchy& hierarchy, const std::vector<NodeIndex>& nodes)
{
  std::uint64_t points = 0;
  for (const NodeIndex node : nodes)
  {
    points += hierarchy.node(node).pointCount;
  }
  return points;
}

/// What comes out. Points of the input have no enclosing radius: the column is left out unless
/// representatives are asked for.
StoreDescription exported(const StoreDescription& store, const ExportSelection& selection)
{
  StoreDescription out = store;
  if (store.refinement == Refinement::Add || selection.spacing > 0.0)
  {
    return out;
  }
  out.schema = {};
  out.ranges.clear();
  for (std::size_t c = 0; c < store.schema.size(); ++c)
  {
    if (store.schema[c].name != enclosingRadiusName)
    {
      out.schema.add(store.schema[c]);
      out.ranges.push_back(store.ranges[c]);
    }
  }
  return out;
}

/// Columns of the store that `out` has.
ColumnSelection columnsOf(const StoreDescription& store, const StoreDescription& out)
{
  ColumnSelection columns;
  for (const Attribute& attribute : out.schema)
  {
    columns.push_back(static_cast<std::uint32_t>(*store.schema.find(attribute.name)));
  }
  return columns;
}

/// Column of the classification if classes are asked for.
Result<std::optional<std::size_t>> classColumnFor(
  const StoreDescription& description, const ExportSelection& selection)
{
  if (selection.classes.empty())
  {
    return std::optional<std::size_t>();
  }
  const std::optional<std::size_t> column = description.schema.find("classification");
  if (!column || description.schema[*column].bytes() != 1)
  {
    return makeError(Error::Kind::BadArgument,
      description.path + ": the store has no classification of one byte to choose classes by");
  }
  return column;
}

Result<ExportReport> pump(NodeStream& nodes, PointFilter& filter, PointSink& sink,
  ExportClock& clock)
{
  ExportReport report;
  PointBatch batch;
  while (!nodes.atEnd())
  {
    const Result<NodeColumns> node = nodes.take();
    if (!node)
    {
      return node.error();
    }
    filter.filter(node.value(), batch);
    report.pointsRead += node->size();
    report.pointsWritten += batch.size();
    if (batch.size() > 0)
    {
      if (Result<void> appended = sink.append(batch); !appended)
      {
        return appended.error();
      }
    }
    if (!clock.report(report.pointsRead))
    {
      return makeError(Error::Kind::Cancelled, "export cancelled");
    }
  }
  return report;
}

} // namespace

Result<ExportReport> exportPoints(const StoreDescription& store, const Hierarchy& hierarchy,
  const NodeReader& reader, const ExportSelection& selection, PointSink& sink,
  const ProgressFunction& progress)
{
  const StoreDescription description = exported(store, selection);
  const Result<std::optional<std::size_t>> classColumn = classColumnFor(description, selection);
  if (!classColumn)
  {
    return classColumn.error();
  }
  if (Result<void> begun = sink.begin(sinkDescription(description, selection)); !begun)
  {
    return begun.error();
  }
  PointFilter filter(description, selection, classColumn.value());
  std::vector<NodeIndex> nodes = chosenNodes(hierarchy, filter, selection.spacing);
  ExportClock clock(progress, pointsOf(hierarchy, nodes));
  if (std::optional<Error> damage = hierarchy.fault())
  {
    return *damage;
  }
  NodeStream stream(reader, std::move(nodes), columnsOf(store, description));
  Result<ExportReport> report = pump(stream, filter, sink, clock);
  if (!report)
  {
    return report;
  }
  if (Result<void> finished = sink.finish(); !finished)
  {
    return finished.error();
  }
  return report;
}

Result<ExportReport> exportStore(const StoredCloud& store, const ExportSelection& selection,
  PointSink& sink, const ProgressFunction& progress)
{
  if (Result<void> apart = checkApart(sink.path(), store.files()); !apart)
  {
    return apart.error();
  }
  return exportPoints(
    store.description(), *store.hierarchy(), store, selection, sink, progress);
}

} // namespace pointfront
