#include "pointfront/Export/SourceSurvey.h"

#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Points/DescribedSource.h"
#include "pointfront/Store/ColumnStatistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

namespace
{
bool isPlace(const glm::dvec3& p)
{
  return std::abs(p.x) <= farthestCoordinate && std::abs(p.y) <= farthestCoordinate &&
    std::abs(p.z) <= farthestCoordinate;
}

/// Box of the points, and the range of each column.
Result<void> readAll(const PointSource& source, Bounds& box, std::vector<ColumnRange>& ranges)
{
  const AttributeSchema& schema = source.description().schema;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    if (Result<void> read = source.read(chunk, batch); !read)
    {
      return read.error();
    }
    for (const glm::dvec3& p : batch.positions)
    {
      if (!isPlace(p))
      {
        return makeError(Error::Kind::BadArgument,
          source.description().path + ": a point has no place: (" + std::to_string(p.x) + ", " +
            std::to_string(p.y) + ", " + std::to_string(p.z) + ")");
      }
      box.add(p);
    }
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      addRange(ranges[c], rangeOf(batch.columns[c].data(), schema[c], batch.size()));
    }
  }
  return {};
}
} // namespace

Result<SinkDescription> surveyed(
  const std::shared_ptr<const PointSource>& source, const std::optional<double>& precision)
{
  SourceDescription about = source->description();
  std::vector<ColumnRange> ranges;
  for (std::size_t c = 0; c < about.schema.size(); ++c)
  {
    ranges.push_back(emptyRange(about.schema[c]));
  }
  about.declaredBounds = Bounds();
  if (Result<void> read = readAll(*source, about.declaredBounds, ranges); !read)
  {
    return read.error();
  }
  SinkDescription told;
  told.schema = about.schema;
  told.bounds = about.declaredBounds;
  told.pointCount = about.pointCount;
  told.crsWkt = about.crsWkt;
  told.metadata = about.metadata;
  for (const ColumnRange& range : ranges)
  {
    double largest = 0.0;
    double smallest = 0.0;
    for (const auto& ends : range.components)
    {
      largest = std::max(largest, ends[1]);
      smallest = std::min(smallest, ends[0]);
    }
    told.largest.push_back(largest);
    told.smallest.push_back(smallest);
  }
  std::vector<std::unique_ptr<PointSource>> alone;
  alone.push_back(std::make_unique<DescribedSource>(source, std::move(about)));
  const auto grid = chooseGrid(alone, precision);
  if (!grid)
  {
    return grid.error();
  }
  told.grid = grid->grid;
  return told;
}

} // namespace pointfront
