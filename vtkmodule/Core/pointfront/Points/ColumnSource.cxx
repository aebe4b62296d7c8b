#include "pointfront/Points/ColumnSource.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pointsOfChunk = 65536;
} // namespace

bool ColumnSource::addColumn(const Attribute& attribute, const void* values, std::size_t stride)
{
  if (!description_.schema.add(attribute))
  {
    return false;
  }
  columns_.push_back({ static_cast<const std::byte*>(values), stride });
  return true;
}

std::uint64_t ColumnSource::chunkCount() const
{
  return (description_.pointCount + pointsOfChunk - 1) / pointsOfChunk;
}

std::uint64_t ColumnSource::chunkPoints(std::uint64_t chunk) const
{
  return std::min(pointsOfChunk, description_.pointCount - chunk * pointsOfChunk);
}

Result<void> ColumnSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  const std::uint64_t first = chunk * pointsOfChunk;
  const std::uint64_t count = chunkPoints(chunk);
  batch.resize(count, description_.schema);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    batch.positions[i] = position(first + i);
  }
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    const std::size_t bytes = description_.schema[c].bytes();
    const std::size_t stride = columns_[c].stride;
    const std::byte* from = columns_[c].values + first * stride;
    std::byte* const to = batch.columns[c].data();
    if (stride == bytes)
    {
      std::memcpy(to, from, count * bytes);
      continue;
    }
    for (std::uint64_t i = 0; i < count; ++i)
    {
      std::memcpy(to + i * bytes, from + i * stride, bytes);
    }
  }
  return {};
}

} // namespace pointfront
