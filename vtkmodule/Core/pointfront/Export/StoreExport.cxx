#include "pointfront/Export/StoreExport.h"

#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Store/ColumnStatistics.h"

#include <algorithm>
#include <memory>

namespace pointfront
{

namespace
{

SinkDescription sinkDescription(const StoreDescription& store, const PointQuery& query)
{
  SinkDescription sink;
  sink.schema = store.schema;
  sink.grid = store.grid;
  sink.bounds = store.bounds;
  for (const std::shared_ptr<const Region>& region : query.regions)
  {
    const Bounds box = region->bounds();
    sink.bounds.low = glm::max(sink.bounds.low, box.low);
    sink.bounds.high = glm::min(sink.bounds.high, box.high);
  }
  const bool everything =
    query.regions.empty() && query.classes.empty() && query.where.empty() && query.spacing <= 0.0;
  sink.pointCount = everything ? store.pointCount : 0;
  for (std::size_t c = 0; c < store.ranges.size(); ++c)
  {
    // Whether colours are of 8 bits in 16 is a guess anyway, which EightBitColourSink checks.
    const bool guess = store.schema[c].name == "rgb";
    double largest = 0.0;
    double smallest = 0.0;
    for (const std::array<double, 2>& component :
      (guess ? store.ranges[c] : certainRange(store, c)).components)
    {
      largest = std::max(largest, component[1]);
      smallest = std::min(smallest, component[0]);
    }
    sink.largest.push_back(largest);
    sink.smallest.push_back(smallest);
  }
  sink.crsWkt = store.crsWkt;
  sink.metadata = store.metadata;
  return sink;
}

/// The selection's box as one more region.
Result<PointQuery> queryOf(const ExportSelection& selection)
{
  PointQuery query = selection;
  if (selection.box)
  {
    const auto box = BoxRegion::make(*selection.box);
    if (!box)
    {
      return box.error();
    }
    query.regions.push_back(*box);
  }
  return query;
}

Result<ExportReport> exportPlanned(const QueryPlan& plan, const PointQuery& query,
  const NodeReader& reader, std::size_t memoryBytes, PointSink& sink,
  const ProgressFunction& progress)
{
  if (Result<void> begun = sink.begin(sinkDescription(plan.description(), query)); !begun)
  {
    return begun.error();
  }
  QueryOptions options;
  options.memoryBytes = std::max(memoryBytes, plan.leastMemoryBytes(reader));
  options.progress = progress;
  options.phase = "exporting";
  const Result<QueryReport> report =
    plan.run(reader, options, [&sink](QueryBatch& batch) { return sink.append(batch.points); });
  if (!report)
  {
    return report.error();
  }
  if (Result<void> finished = sink.finish(); !finished)
  {
    return finished.error();
  }
  return ExportReport{ report->pointsRead, report->pointsChosen };
}

} // namespace

Result<ExportReport> exportPoints(const StoreDescription& store, const Hierarchy& hierarchy,
  const NodeReader& reader, const ExportSelection& selection, PointSink& sink,
  const ProgressFunction& progress)
{
  const Result<PointQuery> query = queryOf(selection);
  if (!query)
  {
    return query.error();
  }
  const Result<QueryPlan> plan = QueryPlan::make(store, hierarchy, *query);
  return plan ? exportPlanned(*plan, *query, reader, selection.memoryBytes, sink, progress)
              : plan.error();
}

Result<ExportReport> exportStore(const StoredCloud& store, const ExportSelection& selection,
  PointSink& sink, const ProgressFunction& progress)
{
  if (Result<void> apart = checkApart(sink.path(), store.files()); !apart)
  {
    return apart.error();
  }
  const StoreDescription& described = store.description();
  if (described.missingPoints() > 0)
  {
    return makeError(Error::Kind::BadArgument,
      described.path + ": shows " + std::to_string(described.pointCount) + " of " +
        std::to_string(described.wholeCount) +
        " points, and an export would lack the others; build a store from the files, or wait until "
        "its build ends");
  }
  const Result<PointQuery> query = queryOf(selection);
  if (!query)
  {
    return query.error();
  }
  const Result<QueryPlan> plan = QueryPlan::make(store, *query);
  return plan ? exportPlanned(*plan, *query, store, selection.memoryBytes, sink, progress)
              : plan.error();
}

Result<std::size_t> leastExportBytes(const StoredCloud& store, const ExportSelection& selection)
{
  const Result<PointQuery> query = queryOf(selection);
  if (!query)
  {
    return query.error();
  }
  const Result<QueryPlan> plan = QueryPlan::make(store, *query);
  return plan ? Result<std::size_t>(plan->leastMemoryBytes(store)) : plan.error();
}

} // namespace pointfront
