#include "pointfront/Table/TableSource.h"

#include "pointfront/Table/FieldRole.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>

namespace pointfront
{
namespace
{
constexpr std::uint64_t sampledChunks = 64;
constexpr double mostSteps = 2147483647.0; // of an extent: 32 bits in a store
constexpr int mostDecimals = 15;

bool isInteger(const TableField& field)
{
  return field.type && *field.type != ScalarType::Float32 && *field.type != ScalarType::Float64;
}

/// Looks through the table: all of it if some field is undecided, else a sample.
Result<std::vector<FieldStatistics>> survey(const PointTable& table, const SurveyOptions& options)
{
  const std::vector<TableField>& fields = table.fields();
  std::vector<bool> looked = undecidedFields(fields);
  const bool all = std::find(looked.begin(), looked.end(), true) != looked.end();
  for (std::size_t f = 0; f < fields.size(); ++f)
  {
    looked[f] = looked[f] || roleOf(fields[f].name).kind == FieldRole::Kind::Position;
  }
  const std::uint64_t chunks = table.chunkCount();
  const std::uint64_t visits = all ? chunks : std::min(chunks, sampledChunks);
  std::vector<FieldStatistics> statistics(fields.size());
  std::mutex mutex; // guards `statistics`
  const auto look = [&](std::uint64_t visit) -> Result<void>
  {
    const std::uint64_t chunk = visits < 2 ? 0 : visit * (chunks - 1) / (visits - 1);
    TableBlock block;
    if (Result<void> done = table.read(chunk, looked, block); !done)
    {
      return done;
    }
    std::vector<FieldStatistics> own(fields.size());
    for (std::size_t f = 0; f < fields.size(); ++f)
    {
      for (const double value : block.columns[f])
      {
        own[f].add(value);
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    for (std::size_t f = 0; f < fields.size(); ++f)
    {
      statistics[f].add(own[f]);
    }
    return {};
  };
  if (Result<void> done = forEachChunk(visits, options, look); !done)
  {
    return done.error();
  }
  return statistics;
}

struct Extent
{
  Bounds bounds;
  std::optional<QuantisationGrid> grid;
};

/// Whether the coordinates lie on a decimal grid that a store can hold, see TableSource.
Extent extentOf(const ColumnPlan& plan, const std::vector<TableField>& fields,
  const std::vector<FieldStatistics>& statistics)
{
  Extent extent;
  int decimals = 0;
  bool exact = true;
  glm::dvec3 low(0.0);
  glm::dvec3 high(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto& field = plan.position[static_cast<std::size_t>(axis)];
    if (!field)
    {
      continue;
    }
    const FieldStatistics& values = statistics[*field];
    if (values.empty())
    {
      return extent;
    }
    low[axis] = values.low;
    high[axis] = values.high;
    exact = exact && (isInteger(fields[*field]) || values.digits > 0);
    decimals = std::max(decimals, values.decimals);
  }
  extent.bounds.add(low);
  extent.bounds.add(high);
  const double step = std::pow(10.0, -decimals);
  const glm::dvec3 size = (high - low) / step;
  if (!exact || decimals > mostDecimals || !(std::max({ size.x, size.y, size.z }) < mostSteps))
  {
    return extent;
  }
  QuantisationGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Written as a quotient: the nearest double to the decimal step.
    grid.scale[axis] = 1.0 / std::pow(10.0, decimals);
    const double reach = std::max(std::abs(low[axis]), std::abs(high[axis]));
    grid.offset[axis] =
      reach / step < mostSteps ? 0.0 : std::round(0.5 * (low[axis] + high[axis]));
  }
  extent.grid = grid;
  return extent;
}

template <typename T>
void storeColumn(const std::vector<double>& values, double factor, std::size_t components,
  std::size_t component, std::byte* to)
{
  to += component * sizeof(T);
  for (const double value : values)
  {
    T stored;
    if constexpr (std::is_floating_point_v<T>)
    {
      stored = static_cast<T>(value * factor);
    }
    else
    {
      constexpr double low = static_cast<double>(std::numeric_limits<T>::min());
      constexpr double high = static_cast<double>(std::numeric_limits<T>::max());
      const double rounded = std::nearbyint(value * factor);
      // NaN compares false with everything: 0. 2^63 as a double is one too many.
      stored = rounded >= high ? std::numeric_limits<T>::max()
        : rounded > low       ? static_cast<T>(rounded)
        : rounded <= low      ? std::numeric_limits<T>::min()
                              : T{ 0 };
    }
    std::memcpy(to, &stored, sizeof stored);
    to += components * sizeof(T);
  }
}

void storeComponent(const Attribute& attribute, const std::vector<double>& values, double factor,
  std::size_t component, std::byte* to)
{
  const std::size_t n = attribute.components;
  switch (attribute.type)
  {
    case ScalarType::Int8:
      return storeColumn<std::int8_t>(values, factor, n, component, to);
    case ScalarType::UInt8:
      return storeColumn<std::uint8_t>(values, factor, n, component, to);
    case ScalarType::Int16:
      return storeColumn<std::int16_t>(values, factor, n, component, to);
    case ScalarType::UInt16:
      return storeColumn<std::uint16_t>(values, factor, n, component, to);
    case ScalarType::Int32:
      return storeColumn<std::int32_t>(values, factor, n, component, to);
    case ScalarType::UInt32:
      return storeColumn<std::uint32_t>(values, factor, n, component, to);
    case ScalarType::Int64:
      return storeColumn<std::int64_t>(values, factor, n, component, to);
    case ScalarType::UInt64:
      return storeColumn<std::uint64_t>(values, factor, n, component, to);
    case ScalarType::Float32:
      return storeColumn<float>(values, factor, n, component, to);
    case ScalarType::Float64:
      return storeColumn<double>(values, factor, n, component, to);
  }
}
} // namespace

Result<std::unique_ptr<PointSource>> TableSource::open(
  std::unique_ptr<PointTable> table, const SurveyOptions& options)
{
  std::vector<FieldStatistics> statistics = table->statistics();
  if (statistics.empty())
  {
    Result<std::vector<FieldStatistics>> surveyed = survey(*table, options);
    if (!surveyed)
    {
      return surveyed.error();
    }
    statistics = std::move(*surveyed);
  }
  const std::vector<TableField>& fields = table->fields();
  Result<ColumnPlan> plan = ColumnPlan::make(fields, statistics, table->path());
  if (!plan)
  {
    return plan.error();
  }
  const Extent extent = extentOf(*plan, fields, statistics);
  auto source =
    std::unique_ptr<TableSource>(new TableSource(std::move(table), std::move(*plan)));
  SourceDescription& description = source->description_;
  description.path = source->table_->path();
  description.format = source->table_->format();
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    description.pointCount += source->chunkPoints(chunk);
  }
  description.declaredBounds = extent.bounds;
  description.grid = extent.grid;
  description.scanners = source->table_->scanners(extent.bounds);
  description.schema = source->plan_.schema;
  description.warnings = source->table_->warnings();
  const std::vector<std::string>& planned = source->plan_.warnings;
  description.warnings.insert(description.warnings.end(), planned.begin(), planned.end());
  return std::unique_ptr<PointSource>(std::move(source));
}

Result<void> TableSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  TableBlock block;
  if (Result<void> done = table_->read(chunk, wanted_, block); !done)
  {
    return done;
  }
  const auto count = static_cast<std::size_t>(chunkPoints(chunk));
  batch.resize(count, description_.schema);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto& field = plan_.position[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < count; ++i)
    {
      batch.positions[i][axis] = field ? block.columns[*field][i] : 0.0;
    }
  }
  for (std::size_t c = 0; c < plan_.columns.size(); ++c)
  {
    const ColumnPlan::Column& column = plan_.columns[c];
    for (std::size_t k = 0; k < column.fields.size(); ++k)
    {
      storeComponent(description_.schema[c], block.columns[column.fields[k]], column.factor, k,
        batch.columns[c].data());
    }
  }
  return {};
}

} // namespace pointfront
