#include "pointfront/Query/StoredPoints.h"

#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/ChosenColumns.h"
#include "pointfront/Store/HeldColours.h"
#include "pointfront/Store/PreviewRecord.h"

#include <cstdint>
#include <limits>
#include <utility>

namespace pointfront
{

namespace
{
bool fitsInSteps(const StoreDescription& store)
{
  if (store.bounds.empty())
  {
    return false;
  }
  // A step of room: bounds are world coordinates, rounded.
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max() - 1;
  const GridPosition low = store.grid.toGrid(store.bounds.low);
  const GridPosition high = store.grid.toGrid(store.bounds.high);
  bool fits = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    fits = fits && low[axis] >= -most && high[axis] <= most;
  }
  return fits;
}
} // namespace

Result<std::unique_ptr<PointSource>> StoredPoints::open(
  std::shared_ptr<const StoredCloud> cloud, const Bounds* box)
{
  if (previewRecordOf(cloud->description().metadata))
  {
    return makeError(Error::Kind::BadArgument,
      cloud->description().path +
        ": is the preview of a build, with a part of the points; wait for the store");
  }
  PointQuery query;
  if (box != nullptr)
  {
    const auto region = BoxRegion::make(*box);
    if (!region)
    {
      return region.error();
    }
    query.regions.push_back(*region);
  }
  Result<QueryPlan> plan = QueryPlan::make(*cloud, query);
  if (!plan)
  {
    return plan.error();
  }
  return std::unique_ptr<PointSource>(
    new StoredPoints(std::move(cloud), std::move(*plan), box == nullptr));
}

StoredPoints::StoredPoints(std::shared_ptr<const StoredCloud> cloud, QueryPlan plan, bool whole)
  : cloud_(std::move(cloud))
  , plan_(std::move(plan))
  , columns_(ChosenColumns::ofInput(cloud_->description()).columns)
{
  const StoreDescription& store = cloud_->description();
  description_.path = store.path;
  for (const std::string& file : cloud_->files())
  {
    if (file != store.path)
    {
      description_.furtherFiles.push_back(file);
    }
  }
  description_.format = store.structure;
  description_.pointCount = plan_.mostPoints();
  if (whole) // nobody has promised the number of a part
  {
    description_.headerPointCount = store.pointCount;
  }
  description_.declaredBounds = store.bounds;
  description_.grid = store.grid;
  description_.schema = plan_.schema();
  description_.crsWkt = store.crsWkt;
  description_.metadata = store.metadata;
  description_.splatRadiusBase = store.splatRadiusBase;
  description_.inTreeOrder = true;
  description_.deepColours = heldColours(store) == HeldColours::Sixteen;
  fitsSteps_ = fitsInSteps(store);
}

Result<NodeColumns> StoredPoints::node(std::uint64_t chunk) const
{
  return cloud_->read(plan_.node(static_cast<std::size_t>(chunk)), columns_);
}

Result<void> StoredPoints::read(std::uint64_t chunk, PointBatch& batch) const
{
  Result<NodeColumns> node = this->node(chunk);
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

Result<void> StoredPoints::readSteps(std::uint64_t chunk, PointBatch& batch) const
{
  if (!fitsSteps_)
  {
    return read(chunk, batch);
  }
  Result<NodeColumns> node = this->node(chunk);
  if (!node)
  {
    return node.error();
  }
  batch.positions.clear();
  batch.steps.resize(node->size());
  for (std::size_t i = 0; i < node->size(); ++i)
  {
    batch.steps[i] = glm::ivec3(node->origin + GridPosition(node->positions[i]));
  }
  batch.columns = std::move(node->columns);
  return {};
}

} // namespace pointfront
