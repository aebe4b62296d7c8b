#include "PlainColumns.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{

constexpr std::uint64_t firstRoom = 1 << 16; // points
constexpr std::size_t ownColumns = 2; // places and ids

bool isScaled(const Attribute& attribute)
{
  return attribute.scale != 1.0 || attribute.offset != 0.0;
}

} // namespace

PlainColumns::PlainColumns(const StoreDescription& description, std::uint64_t mostPoints)
  : schema_(description.schema)
  , mostPoints_(mostPoints)
{
  columns_.push_back({ "", ScalarType::Float64, 3 });
  columns_.push_back({ "id", ScalarType::Int64, 1 });
  for (const Attribute& attribute : schema_)
  {
    const ScalarType type = isScaled(attribute) ? ScalarType::Float64 : attribute.type;
    columns_.push_back({ attribute.name, type, attribute.components });
  }
}

std::size_t PlainColumns::bytesOf(const Column& column)
{
  return sizeOf(column.type) * column.components;
}

bool PlainColumns::resize(std::uint64_t points)
{
  for (Column& column : columns_)
  {
    const std::size_t bytes = std::max<std::size_t>(1, points * bytesOf(column));
    void* const moved = std::realloc(column.memory.get(), bytes);
    if (moved == nullptr)
    {
      return false;
    }
    static_cast<void>(column.memory.release());
    column.memory.reset(moved);
  }
  room_ = points;
  return true;
}

Result<void> PlainColumns::add(const QueryBatch& batch)
{
  const std::uint64_t first = points_;
  const std::uint64_t all = first + batch.size();
  if (all > mostPoints_)
  {
    return makeError(Error::Kind::NoMemory,
      "more than " + std::to_string(mostPoints_) +
        " points are chosen; choose less, a coarser spacing, or raise maximum_number_of_points");
  }
  if (all > room_ && !resize(std::max({ all, 2 * room_, firstRoom })))
  {
    return makeError(Error::Kind::NoMemory,
      "the system gives no memory for " + std::to_string(all) + " points; choose less");
  }
  points_ = all;
  auto* const places = static_cast<double*>(columns_[0].memory.get()) + 3 * first;
  auto* const ids = static_cast<std::int64_t*>(columns_[1].memory.get()) + first;
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    std::copy_n(&batch.points.positions[i].x, 3, places + 3 * i);
    ids[i] = static_cast<std::int64_t>(batch.ids[i]);
  }
  for (std::size_t c = 0; c < schema_.size(); ++c)
  {
    this->fill(c, batch.points.columns[c].data(), first, batch.size());
  }
  return {};
}

void PlainColumns::fill(
  std::size_t column, const std::byte* from, std::uint64_t first, std::size_t count)
{
  const Attribute& attribute = schema_[column];
  const Column& to = columns_[ownColumns + column];
  const std::size_t values = count * attribute.components;
  auto* const bytes = static_cast<std::byte*>(to.memory.get()) + first * bytesOf(to);
  if (values == 0)
  {
    return;
  }
  if (!isScaled(attribute))
  {
    std::memcpy(bytes, from, values * sizeOf(attribute.type));
    return;
  }
  auto* const doubles = reinterpret_cast<double*>(bytes);
  visitScalar(attribute.type,
    [&](auto value)
    {
      for (std::size_t i = 0; i < values; ++i)
      {
        std::memcpy(&value, from + i * sizeof(value), sizeof(value));
        doubles[i] = static_cast<double>(value) * attribute.scale + attribute.offset;
      }
    });
}

std::vector<PlainColumns::Column> PlainColumns::take()
{
  // A column that the system does not make smaller stays as large as it is.
  static_cast<void>(this->resize(points_));
  return std::move(columns_);
}

} // namespace pointfront
