#include "ArraySource.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pointsOfChunk = 65536;
} // namespace

ArraySource::ArraySource(const double* places, std::uint64_t points)
  : places_(places)
{
  description_.path = "the arrays";
  description_.format = "NumPy arrays";
  description_.pointCount = points;
}

bool ArraySource::add(const Attribute& attribute, const void* values)
{
  if (!description_.schema.add(attribute))
  {
    return false;
  }
  columns_.push_back(static_cast<const std::byte*>(values));
  return true;
}

std::uint64_t ArraySource::chunkCount() const
{
  return (description_.pointCount + pointsOfChunk - 1) / pointsOfChunk;
}

std::uint64_t ArraySource::chunkPoints(std::uint64_t chunk) const
{
  return std::min(pointsOfChunk, description_.pointCount - chunk * pointsOfChunk);
}

Result<void> ArraySource::read(std::uint64_t chunk, PointBatch& batch) const
{
  const std::uint64_t first = chunk * pointsOfChunk;
  const std::uint64_t count = chunkPoints(chunk);
  batch.resize(count, description_.schema);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const double* const place = places_ + 3 * (first + i);
    batch.positions[i] = { place[0], place[1], place[2] };
  }
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    const std::size_t bytes = description_.schema[c].bytes();
    std::memcpy(batch.columns[c].data(), columns_[c] + first * bytes, count * bytes);
  }
  return {};
}

} // namespace pointfront
