#include "pointfront/Statistics/StoredPoints.h"

#include "pointfront/Query/ChosenColumns.h"

#include <utility>

namespace pointfront
{

Result<std::unique_ptr<PointSource>> StoredPoints::open(std::shared_ptr<const StoredCloud> cloud)
{
  Result<QueryPlan> plan = QueryPlan::make(*cloud, {});
  if (!plan)
  {
    return plan.error();
  }
  return std::unique_ptr<PointSource>(new StoredPoints(std::move(cloud), std::move(*plan)));
}

StoredPoints::StoredPoints(std::shared_ptr<const StoredCloud> cloud, QueryPlan plan)
  : cloud_(std::move(cloud))
  , plan_(std::move(plan))
  , columns_(ChosenColumns::ofInput(cloud_->description()).columns)
{
  const StoreDescription& store = cloud_->description();
  description_.path = store.path;
  description_.format = store.structure;
  description_.pointCount = plan_.mostPoints();
  description_.headerPointCount = store.pointCount;
  description_.declaredBounds = store.bounds;
  description_.grid = store.grid;
  description_.schema = plan_.schema();
  description_.crsWkt = store.crsWkt;
  description_.splatRadiusBase = store.splatRadiusBase;
}

Result<void> StoredPoints::read(std::uint64_t chunk, PointBatch& batch) const
{
  Result<NodeColumns> node = cloud_->read(plan_.node(static_cast<std::size_t>(chunk)), columns_);
  if (!node)
  {
    return node.error();
  }
  const QuantisationGrid& grid = *description_.grid;
  batch.steps.clear();
  batch.positions.resize(node->size());
  for (std::size_t i = 0; i < node->size(); ++i)
  {
    batch.positions[i] = grid.toWorld(node->origin + GridPosition(node->positions[i]));
  }
  batch.columns = std::move(node->columns);
  return {};
}

} // namespace pointfront
