#include "EstimatedInput.h"

#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Records/RecordLayout.h"

#include <algorithm>

namespace pointfront
{
namespace
{

constexpr unsigned filesLookedAt = 8;

double bytesOf(const AttributeSchema& schema)
{
  return double(RecordLayout(schema).bytes());
}

/// The attributes that are not known to have one value.
AttributeSchema varying(const StoreDescription& cloud)
{
  AttributeSchema schema;
  for (std::size_t c = 0; c < cloud.schema.size(); ++c)
  {
    const auto isOne = [](const std::array<double, 2>& range) { return range[0] >= range[1]; };
    const auto known = c < cloud.ranges.size() ? cloud.ranges[c] : ColumnRange();
    const bool constant = !known.components.empty() &&
      std::all_of(known.components.begin(), known.components.end(), isOne);
    if (!cloud.isComputed(c) && !constant)
    {
      schema.add(cloud.schema[c]);
    }
  }
  return schema;
}

AttributeSchema varying(const std::vector<std::unique_ptr<PointSource>>& source)
{
  const Result<CommonSchema> common = commonSchema(source, std::nullopt, SchemaOf::AllSources);
  if (!common)
  {
    return source.front()->description().schema;
  }
  const std::vector<bool> all(common->schema.size(), true);
  return guessColumns(source, *common, { all, true }).schema();
}

} // namespace

EstimatedInput EstimatedInput::of(const StoreDescription& cloud)
{
  EstimatedInput input;
  input.points = double(cloud.pointCount + cloud.missingPoints());
  input.attributes = cloud.schema.size();
  input.recordBytes = { bytesOf(varying(cloud)), bytesOf(cloud.schema) };
  return input;
}

EstimatedInput RecordLook::of(
  std::uint64_t points, const std::vector<std::unique_ptr<PointSource>>& source)
{
  const SourceDescription& description = source.front()->description();
  EstimatedInput input;
  input.format = description.format;
  input.points = double(points);
  input.attributes = description.schema.size();
  const double all = bytesOf(description.schema);
  double bytes = allBytes_ > 0.0 ? all * varyingBytes_ / allBytes_ : all;
  if (looked_ < filesLookedAt)
  {
    bytes = bytesOf(varying(source));
    ++looked_;
    allBytes_ += all;
    varyingBytes_ += bytes;
  }
  input.recordBytes = { bytes, bytes };
  return input;
}

} // namespace pointfront
