#include "pointfront/Store/DescriptionSection.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Store/StoreFormat.h"

#include <cmath>
#include <numeric>

namespace pointfront
{
namespace
{
constexpr unsigned maxComponents = 16;

template <typename V>
void putVector(ByteWriter& out, const V& v)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    out.put(v[axis]);
  }
}

template <typename V>
V getVector(ByteReader& in)
{
  V v{ 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    v[axis] = in.get<typename V::value_type>();
  }
  return v;
}

void putColumn(ByteWriter& out, const Attribute& attribute, const ColumnRange& range)
{
  out.putText(attribute.name);
  out.putText(attribute.description);
  out.put(static_cast<std::uint8_t>(attribute.type));
  out.put(attribute.components);
  out.put(attribute.scale);
  out.put(attribute.offset);
  for (unsigned c = 0; c < attribute.components; ++c)
  {
    out.put(range.components[c][0]);
    out.put(range.components[c][1]);
  }
}

bool getColumn(ByteReader& in, StoreDescription& description)
{
  Attribute attribute;
  attribute.name = in.getText();
  attribute.description = in.getText();
  const std::optional<ScalarType> type = scalarTypeOf(in.get<std::uint8_t>());
  attribute.components = in.get<std::uint8_t>();
  attribute.scale = in.get<double>();
  attribute.offset = in.get<double>();
  if (!type || attribute.components < 1 || attribute.components > maxComponents ||
    !std::isfinite(attribute.scale) || attribute.scale == 0.0 || !std::isfinite(attribute.offset))
  {
    return false;
  }
  attribute.type = *type;
  ColumnRange range;
  for (unsigned c = 0; c < attribute.components; ++c)
  {
    const double low = in.get<double>();
    range.components.push_back({ low, in.get<double>() });
  }
  description.ranges.push_back(range);
  return in.ok() && description.schema.add(std::move(attribute));
}

bool getColumns(ByteReader& in, StoreDescription& description)
{
  const auto columns = in.get<std::uint32_t>();
  if (columns > maxColumns)
  {
    return false;
  }
  for (std::uint32_t c = 0; c < columns; ++c)
  {
    if (!getColumn(in, description))
    {
      return false;
    }
  }
  return true;
}

bool getLayers(ByteReader& in, StoreDescription& description)
{
  const auto layers = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < layers && in.ok(); ++i)
  {
    Layer layer;
    layer.objectClass = in.get<std::uint16_t>();
    layer.name = in.getText();
    description.layers.push_back(std::move(layer));
  }
  return in.ok();
}

bool getMetadata(ByteReader& in, StoreDescription& description)
{
  const auto records = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < records && in.ok(); ++i)
  {
    MetadataRecord record;
    record.owner = in.getText();
    record.id = in.get<std::uint16_t>();
    record.description = in.getText();
    const auto size = in.get<std::uint64_t>();
    if (size > in.remaining())
    {
      return false;
    }
    const std::byte* const payload = in.getBytes(static_cast<std::size_t>(size));
    record.payload.assign(payload, payload + size);
    description.metadata.push_back(std::move(record));
  }
  return in.ok();
}

/// Since version 2.
void putTableSummary(ByteWriter& out, const StoredDescription& stored)
{
  out.put(stored.description.levels);
  for (const Layer& layer : stored.description.layers)
  {
    out.put(layer.pointCount);
    out.put(layer.nodeCount);
  }
  out.put(static_cast<std::uint32_t>(stored.roots.size()));
  for (const NodeIndex root : stored.roots)
  {
    out.put(root);
  }
}

bool getTableSummary(ByteReader& in, StoredDescription& stored)
{
  stored.description.levels = in.get<std::uint32_t>();
  for (Layer& layer : stored.description.layers)
  {
    layer.pointCount = in.get<std::uint64_t>();
    layer.nodeCount = in.get<std::uint32_t>();
  }
  const auto roots = in.get<std::uint32_t>();
  if (!in.ok() || roots > stored.description.layers.size())
  {
    return false;
  }
  for (std::uint32_t r = 0; r < roots; ++r)
  {
    stored.roots.push_back(in.get<NodeIndex>());
    if (r > 0 && stored.roots[r] <= stored.roots[r - 1])
    {
      return false;
    }
  }
  return in.ok();
}

/// Since version 3.
bool getSplatBase(ByteReader& in, StoreDescription& description)
{
  description.splatRadiusBase = in.get<double>();
  return in.ok() && std::isfinite(description.splatRadiusBase) &&
    description.splatRadiusBase >= 0.0;
}

bool soundGrid(const QuantisationGrid& grid)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(grid.scale[axis]) || grid.scale[axis] <= 0.0 ||
      !std::isfinite(grid.offset[axis]))
    {
      return false;
    }
  }
  return true;
}
} // namespace

std::vector<std::byte> encodeDescription(const StoredDescription& stored, std::uint32_t version)
{
  const StoreDescription& d = stored.description;
  ByteWriter out;
  out.reserve(4096 +
    std::accumulate(d.metadata.begin(), d.metadata.end(), std::size_t(0),
      [](std::size_t sum, const MetadataRecord& record) { return sum + record.payload.size(); }));
  putVector(out, d.grid.scale);
  putVector(out, d.grid.offset);
  putVector(out, stored.gridBounds.low);
  putVector(out, stored.gridBounds.high);
  out.put(static_cast<std::uint8_t>(d.refinement));
  out.putText(d.structure);
  out.putText(d.generator);
  out.putText(d.crsWkt);
  out.put(static_cast<std::uint32_t>(d.schema.size()));
  for (std::size_t c = 0; c < d.schema.size(); ++c)
  {
    putColumn(out, d.schema[c], d.ranges[c]);
  }
  out.put(static_cast<std::uint32_t>(d.layers.size()));
  for (const Layer& layer : d.layers)
  {
    out.put(layer.objectClass);
    out.putText(layer.name);
  }
  out.put(static_cast<std::uint32_t>(d.metadata.size()));
  for (const MetadataRecord& record : d.metadata)
  {
    out.putText(record.owner);
    out.put(record.id);
    out.putText(record.description);
    out.put(static_cast<std::uint64_t>(record.payload.size()));
    out.putBytes(record.payload.data(), record.payload.size());
  }
  if (version >= 2)
  {
    putTableSummary(out, stored);
  }
  if (version >= 3)
  {
    out.put(d.splatRadiusBase);
  }
  return out.take();
}

std::optional<StoredDescription> decodeDescription(
  const std::byte* data, std::size_t size, std::uint32_t version)
{
  ByteReader in(data, size);
  StoredDescription stored;
  StoreDescription& d = stored.description;
  d.grid.scale = getVector<glm::dvec3>(in);
  d.grid.offset = getVector<glm::dvec3>(in);
  stored.gridBounds.low = getVector<GridPosition>(in);
  stored.gridBounds.high = getVector<GridPosition>(in);
  const auto refinement = in.get<std::uint8_t>();
  d.structure = in.getText();
  d.generator = in.getText();
  d.crsWkt = in.getText();
  if (!in.ok() || !soundGrid(d.grid) || refinement < 1 || refinement > 2 || !getColumns(in, d) ||
    !getLayers(in, d) || !getMetadata(in, d) || (version >= 2 && !getTableSummary(in, stored)) ||
    (version >= 3 && !getSplatBase(in, d)) || in.remaining() != 0)
  {
    return std::nullopt;
  }
  d.refinement = static_cast<Refinement>(refinement);
  d.bounds = stored.gridBounds.toWorld(d.grid);
  return stored;
}

} // namespace pointfront
