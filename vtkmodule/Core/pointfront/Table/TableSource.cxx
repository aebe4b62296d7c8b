#include "pointfront/Table/TableSource.h"

#include "pointfront/Table/DecimalStep.h"
#include "pointfront/Table/FieldRole.h"
#include "pointfront/Table/PositionSurvey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>

namespace pointfront
{
namespace
{
constexpr std::uint64_t sampledChunks = 64;

bool isInteger(const TableField& field)
{
  return field.type && *field.type != ScalarType::Float32 && *field.type != ScalarType::Float64;
}

/// Facts of the values of a table's fields.
struct Survey
{
  std::vector<FieldStatistics> statistics; ///< a field each
  std::vector<DecimalStep> steps; ///< the same; of floating point positions that were seen
  bool whole = true; ///< all values were looked at

  explicit Survey(const std::vector<TableField>& fields)
    : statistics(fields.size())
  {
    for (const TableField& field : fields)
    {
      steps.emplace_back(field.type.value_or(ScalarType::Float64));
    }
  }
  void add(const Survey& other)
  {
    for (std::size_t f = 0; f < statistics.size(); ++f)
    {
      statistics[f].add(other.statistics[f]);
      steps[f].add(other.steps[f]);
    }
  }
};

std::vector<bool> positionFields(const std::vector<TableField>& fields)
{
  std::vector<std::string> names;
  names.reserve(fields.size());
  for (const TableField& field : fields)
  {
    names.push_back(field.name);
  }
  std::vector<bool> positions;
  for (const FieldRole& role : rolesOf(names))
  {
    positions.push_back(role.kind == FieldRole::Kind::Position);
  }
  return positions;
}

/// Looks at some fields in so many chunks, spread over the table.
Result<Survey> look(const PointTable& table, const SurveyOptions& options,
  const std::vector<bool>& looked, std::uint64_t visits)
{
  const std::uint64_t chunks = table.chunkCount();
  const std::vector<bool> positions = positionFields(table.fields());
  Survey survey(table.fields());
  survey.whole = visits == chunks;
  std::mutex mutex; // guards `survey`
  const auto visit = [&](std::uint64_t number) -> Result<void>
  {
    const std::uint64_t chunk = visits < 2 ? 0 : number * (chunks - 1) / (visits - 1);
    TableBlock block;
    if (Result<void> done = table.read(chunk, looked, block); !done)
    {
      return done;
    }
    Survey own(table.fields());
    for (std::size_t f = 0; f < positions.size(); ++f)
    {
      for (const double value : block.columns[f])
      {
        if (positions[f] && std::abs(value) > farthestCoordinate)
        {
          continue; // no position: the build rejects it
        }
        own.statistics[f].add(value);
        if (positions[f])
        {
          own.steps[f].add(value);
        }
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    survey.add(own);
    return {};
  };
  if (Result<void> done = forEachChunk(visits, options, visit); !done)
  {
    return done.error();
  }
  return survey;
}

/// True if some position is of floating point, and all that are have a decimal step.
bool decimalPositions(const PointTable& table, const Survey& survey)
{
  const std::vector<TableField>& fields = table.fields();
  const std::vector<bool> positions = positionFields(fields);
  bool some = false;
  for (std::size_t f = 0; f < fields.size(); ++f)
  {
    if (positions[f] && !isInteger(fields[f]))
    {
      some = true;
      if (!survey.steps[f].decimals())
      {
        return false;
      }
    }
  }
  return some;
}

/// Positions that are none must not decide on bounds and step of the others.
Result<void> leaveOutFar(const PointTable& table, const SurveyOptions& options, Survey& survey)
{
  const std::vector<bool> positions = positionFields(table.fields());
  bool far = false;
  for (std::size_t f = 0; f < positions.size(); ++f)
  {
    const FieldStatistics& values = survey.statistics[f];
    far = far ||
      (positions[f] && !values.empty() &&
        std::max(std::abs(values.low), std::abs(values.high)) > farthestCoordinate);
  }
  if (!far)
  {
    return {};
  }
  const Result<Survey> near = look(table, options, positions, table.chunkCount());
  if (!near)
  {
    return near.error();
  }
  for (std::size_t f = 0; f < positions.size(); ++f)
  {
    if (positions[f])
    {
      survey.statistics[f].low = near->statistics[f].low;
      survey.statistics[f].high = near->statistics[f].high;
    }
  }
  return {};
}

/// Looks through the table: all of it if some field is undecided, else a sample. If that seems to
/// have decimal positions, all positions: a grid on which one of them does not lie would round it.
Result<Survey> surveyed(const PointTable& table, const SurveyOptions& options)
{
  if (std::vector<FieldStatistics> known = table.statistics(); !known.empty())
  {
    Survey survey(table.fields());
    survey.statistics = std::move(known);
    if (Result<void> done = leaveOutFar(table, options, survey); !done)
    {
      return done.error();
    }
    return survey;
  }
  std::vector<bool> looked = undecidedFields(table.fields());
  const bool all = std::find(looked.begin(), looked.end(), true) != looked.end();
  const std::vector<bool> positions = positionFields(table.fields());
  for (std::size_t f = 0; f < looked.size(); ++f)
  {
    looked[f] = looked[f] || positions[f];
  }
  const std::uint64_t chunks = table.chunkCount();
  Result<Survey> survey =
    look(table, options, looked, all ? chunks : std::min(chunks, sampledChunks));
  if (survey && !survey->whole && decimalPositions(table, *survey))
  {
    survey = look(table, options, positions, chunks);
  }
  return survey;
}

/// Whether the coordinates lie on a decimal grid that a store can hold, see TableSource.
PositionExtent extentOf(const ColumnPlan& plan, const std::vector<TableField>& fields,
  const Survey& survey, const glm::dvec3& origin)
{
  std::array<AxisFacts, 3> axes;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
  {
    const auto& field = plan.position[axis];
    if (!field)
    {
      continue;
    }
    const FieldStatistics& values = survey.statistics[*field];
    if (values.empty())
    {
      return {};
    }
    const bool text = values.digits > 0;
    const std::optional<int> decimals = text || isInteger(fields[*field]) ? values.decimals
      : survey.whole ? survey.steps[*field].decimals()
                     : std::nullopt;
    axes[axis] = { values.low, values.high, decimals };
  }
  return extentOf(axes, origin);
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
        : rounded > low        ? static_cast<T>(rounded)
        : rounded <= low       ? std::numeric_limits<T>::min()
                               : T{ 0 };
    }
    std::memcpy(to, &stored, sizeof stored);
    to += components * sizeof(T);
  }
}

/// Exact integers; `values` are the same as doubles.
template <typename T>
void storeWholes(const std::vector<std::uint64_t>& wholes, const std::vector<double>& values,
  std::size_t components, std::size_t component, std::byte* to)
{
  constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<T>::max());
  constexpr bool hasSign = std::is_signed_v<T>;
  to += component * sizeof(T);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::uint64_t bits =
      values[i] < 0.0 ? (hasSign ? wholes[i] : 0) : std::min(wholes[i], largest);
    std::memcpy(to, &bits, sizeof bits);
    to += components * sizeof(T);
  }
}

void storeComponent(const Attribute& attribute, const std::vector<double>& values, double factor,
  std::size_t component, std::byte* to)
{
  visitScalar(attribute.type,
    [&](auto zero)
    { storeColumn<decltype(zero)>(values, factor, attribute.components, component, to); });
}
} // namespace

Result<std::unique_ptr<PointSource>> TableSource::open(
  std::unique_ptr<PointTable> table, const SurveyOptions& options)
{
  Result<std::unique_ptr<TableSource>> source = make(std::move(table), options);
  return source ? Result<std::unique_ptr<PointSource>>(std::move(*source)) : source.error();
}

Result<std::unique_ptr<TableSource>> TableSource::make(
  std::unique_ptr<PointTable> table, const SurveyOptions& options)
{
  const Result<Survey> survey = surveyed(*table, options);
  if (!survey)
  {
    return survey.error();
  }
  const std::vector<TableField>& fields = table->fields();
  Result<ColumnPlan> plan = ColumnPlan::make(fields, survey->statistics, table->path());
  if (!plan)
  {
    return plan.error();
  }
  const PositionExtent extent = extentOf(*plan, fields, *survey, table->origin());
  auto source = std::unique_ptr<TableSource>(new TableSource(std::move(table), std::move(*plan)));
  SourceDescription& description = source->description_;
  description.path = source->table_->path();
  description.format = source->table_->format();
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    description.pointCount += source->chunkPoints(chunk);
  }
  description.headerPointCount = source->table_->headerPointCount();
  description.grid = source->table_->grid();
  extent.describe(description);
  description.scanners = source->table_->scanners(extent.bounds);
  description.schema = source->plan_.schema;
  description.warnings = source->table_->warnings();
  const std::vector<std::string>& planned = source->plan_.warnings;
  description.warnings.insert(description.warnings.end(), planned.begin(), planned.end());
  return source;
}

Result<void> TableSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  TableBlock block;
  if (Result<void> done = table_->read(chunk, wanted_, block); !done)
  {
    return done;
  }
  convert(block, static_cast<std::size_t>(chunkPoints(chunk)), batch);
  return {};
}

void TableSource::convert(const TableBlock& block, std::size_t count, PointBatch& batch) const
{
  batch.resize(count, description_.schema);
  const glm::dvec3 origin = table_->origin();
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto& field = plan_.position[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < count; ++i)
    {
      batch.positions[i][axis] = origin[axis] + (field ? block.columns[*field][i] : 0.0);
    }
  }
  for (std::size_t c = 0; c < plan_.columns.size(); ++c)
  {
    const ColumnPlan::Column& column = plan_.columns[c];
    for (std::size_t k = 0; k < column.fields.size(); ++k)
    {
      const Attribute& attribute = description_.schema[c];
      const std::size_t field = column.fields[k];
      const std::vector<double>& values = block.columns[field];
      std::byte* const to = batch.columns[c].data();
      const bool exact =
        column.factor == 1.0 && field < block.wholes.size() && !block.wholes[field].empty();
      if (exact && attribute.type == ScalarType::Int64)
      {
        storeWholes<std::int64_t>(block.wholes[field], values, attribute.components, k, to);
      }
      else if (exact && attribute.type == ScalarType::UInt64)
      {
        storeWholes<std::uint64_t>(block.wholes[field], values, attribute.components, k, to);
      }
      else
      {
        storeComponent(attribute, values, column.factor, k, to);
      }
    }
  }
}

} // namespace pointfront
