#include "ProjectedSink.h"

#include "ProjCoordinateSystems.h"
#include "TransformedExtent.h"

#include "pointfront/Disk/SmallFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
std::string definitionOf(const std::string& target)
{
  std::error_code failure;
  if (!std::filesystem::is_regular_file(target, failure))
  {
    return target;
  }
  const Result<std::string> text = readSmallText(target, mostDefinitionBytes);
  return text ? *text : target; // which is then refused as a definition
}
} // namespace

ProjectedSink::ProjectedSink(
  std::unique_ptr<PointSink> sink, std::string target, std::string assumedName)
  : ForwardingSink(std::move(sink))
  , target_(std::move(target))
  , assumedName_(std::move(assumedName))
{
}

ProjectedSink::~ProjectedSink() = default;

Result<void> ProjectedSink::begin(const SinkDescription& description)
{
  if (description.crsWkt.empty())
  {
    return makeError(Error::Kind::BadArgument,
      "the points name no coordinate reference system to "
      "transform them from; build the store with " +
        assumedName_);
  }
  const ProjCoordinateSystems known;
  const Result<CoordinateSystem> from = known.parse(description.crsWkt);
  const Result<CoordinateSystem> to = known.parse(definitionOf(target_));
  if (!from || !to)
  {
    return !from ? from.error() : to.error();
  }
  SinkDescription result = description;
  schema_ = description.schema;
  if (!known.equivalent(*from, *to, !from->vertical || !to->vertical))
  {
    Result<std::unique_ptr<CoordinateTransform>> made =
      known.transform(*from, *to, description.bounds);
    if (!made)
    {
      return made.error();
    }
    transform_ = std::move(*made);
    if (!description.bounds.empty())
    {
      const Result<Bounds> moved = transformedBounds(description.bounds, *transform_);
      if (!moved)
      {
        return moved.error();
      }
      result.bounds = *moved;
    }
    SourceDescription source;
    source.grid = description.grid;
    source.declaredBounds = result.bounds;
    result.grid = transformedGrid(source, *from, *to, result.bounds, std::nullopt);
    result.stepBefore = transformedSteps(description.grid.scale, *from, *to);
    result.pointCount = 0; // some may be left out
  }
  result.crsWkt = to->wkt;
  result.metadata.erase(
    std::remove_if(result.metadata.begin(), result.metadata.end(),
      [](const MetadataRecord& record) { return record.owner == "LASF_Projection"; }),
    result.metadata.end());
  return ForwardingSink::begin(result);
}

Result<void> ProjectedSink::append(const PointBatch& batch)
{
  if (!transform_)
  {
    return ForwardingSink::append(batch);
  }
  batch_ = batch;
  if (Result<void> done = transform_->apply(batch_.positions.data(), batch_.size()); !done)
  {
    return done;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    const glm::dvec3& p = batch_.positions[i];
    if (!std::isfinite(p.x + p.y + p.z))
    {
      continue;
    }
    for (std::size_t c = 0; kept != i && c < schema_.size(); ++c)
    {
      const std::size_t bytes = schema_[c].bytes();
      std::byte* const column = batch_.columns[c].data();
      std::memcpy(column + kept * bytes, column + i * bytes, bytes);
    }
    batch_.positions[kept++] = p;
  }
  lost_ += batch.size() - kept;
  batch_.resize(kept, schema_);
  return kept > 0 ? ForwardingSink::append(batch_) : Result<void>();
}

std::vector<std::string> ProjectedSink::findings() const
{
  std::vector<std::string> all = ForwardingSink::findings();
  if (transform_)
  {
    const std::vector<std::string>& doubts = transform_->warnings();
    all.insert(all.end(), doubts.begin(), doubts.end());
  }
  if (lost_ > 0)
  {
    all.push_back(std::to_string(lost_) +
      " points are left out: they cannot be transformed into the system that is asked for.");
  }
  return all;
}

} // namespace pointfront
