#include "PickedPoint.h"

#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Query/ChosenColumns.h"
#include "pointfront/Query/PointsById.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace pointfront
{

namespace
{
/// The double that is written as the float is: 0.1 and not 0.10000000149.
double asWritten(float value)
{
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text - 1, value);
  *end.ptr = '\0';
  return std::strtod(text, nullptr);
}

/// One component.
nlohmann::ordered_json valueOf(const Attribute& attribute, const std::byte* bytes)
{
  return visitScalar(attribute.type,
    [&attribute, bytes](auto zero) -> nlohmann::ordered_json
    {
      decltype(zero) stored;
      std::memcpy(&stored, bytes, sizeof stored);
      if (attribute.scale != 1.0 || attribute.offset != 0.0)
      {
        return static_cast<double>(stored) * attribute.scale + attribute.offset;
      }
      if constexpr (std::is_same_v<decltype(zero), float>)
      {
        return asWritten(stored);
      }
      else
      {
        return stored;
      }
    });
}

nlohmann::ordered_json valuesOf(const Attribute& attribute, const std::vector<std::byte>& column)
{
  if (attribute.components == 1)
  {
    return valueOf(attribute, column.data());
  }
  nlohmann::ordered_json values = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < attribute.components; ++i)
  {
    values.push_back(valueOf(attribute, column.data() + i * sizeOf(attribute.type)));
  }
  return values;
}

std::string valueText(const std::string& name, const nlohmann::ordered_json& value)
{
  std::string text;
  for (const char c : value.dump())
  {
    text += c == '[' || c == ']' ? "" : c == ',' ? " " : std::string(1, c);
  }
  if (name == "classification" && value.is_number_integer())
  {
    text += " " + objectClassName(static_cast<std::uint8_t>(value.get<int>()));
  }
  return text;
}
} // namespace

Result<PickedPoint> readPoint(const StoredCloud& store, std::uint64_t id)
{
  const Result<ChosenColumns> columns = ChosenColumns::make(store.description(), std::nullopt);
  if (!columns)
  {
    return columns.error();
  }
  PickedPoint point;
  point.store = store.description().path;
  point.id = id;
  const AttributeSchema& schema = columns->description.schema;
  const Result<QueryReport> read = pointsById(store, { id }, std::nullopt, QueryOptions(),
    [&point, &schema](QueryBatch& batch) -> Result<void>
    {
      point.position = batch.points.positions.front();
      for (std::size_t c = 0; c < schema.size(); ++c)
      {
        point.attributes[schema[c].name] = valuesOf(schema[c], batch.points.columns[c]);
      }
      return {};
    });
  return read ? Result<PickedPoint>(std::move(point)) : read.error();
}

std::string textOf(const PickedPoint& point)
{
  char place[120];
  std::snprintf(
    place, sizeof place, "%.3f %.3f %.3f\n", point.position.x, point.position.y, point.position.z);
  std::size_t width = 0;
  for (const auto& [name, value] : point.attributes.items())
  {
    width = std::max(width, name.size() + 1);
  }
  std::string text = place;
  for (const auto& [name, value] : point.attributes.items())
  {
    std::string label = name;
    label.resize(width, ' ');
    text += label + valueText(name, value) + "\n";
  }
  return text;
}

nlohmann::ordered_json jsonOf(const PickedPoint& point)
{
  nlohmann::ordered_json object;
  object["store"] = point.store;
  object["id"] = point.id;
  object["x"] = point.position.x;
  object["y"] = point.position.y;
  object["z"] = point.position.z;
  for (const auto& [name, value] : point.attributes.items())
  {
    object[object.contains(name) ? name + "_" : name] = value;
  }
  return object;
}

} // namespace pointfront
