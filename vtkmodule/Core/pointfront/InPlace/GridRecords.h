#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pointfront
{

/// The points of a file as they lie there: records of one width, each beginning with its grid
/// position, three little-endian int32. An uncompressed LAS file, mapped into memory, has this
/// form.
/// Lifetime  the bytes belong to whoever maps the file.
struct GridRecords
{
  const std::byte* first = nullptr;
  std::size_t stride = 0; ///< bytes from one record to the next, at least 12
  std::uint64_t count = 0;
  std::uint64_t fileOffset = 0; ///< offset of the first record: tells which pages a record lies on

  const std::byte* record(std::uint64_t index) const { return first + index * stride; }
  glm::ivec3 position(std::uint64_t index) const
  {
    std::int32_t p[3];
    std::memcpy(p, record(index), sizeof p);
    return { p[0], p[1], p[2] };
  }
};

/// The smallest box of grid positions around some records; low > high when there are none.
struct RecordBox
{
  glm::ivec3 low{ INT32_MAX };
  glm::ivec3 high{ INT32_MIN };

  bool empty() const { return low.x > high.x; }
  void add(const glm::ivec3& p)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = p[axis] < low[axis] ? p[axis] : low[axis];
      high[axis] = p[axis] > high[axis] ? p[axis] : high[axis];
    }
  }
  void add(const RecordBox& other)
  {
    if (!other.empty())
    {
      add(other.low);
      add(other.high);
    }
  }
};

/// The box of records [begin, end).
inline RecordBox boxOf(const GridRecords& records, std::uint64_t begin, std::uint64_t end)
{
  RecordBox box;
  for (std::uint64_t i = begin; i < end; ++i)
  {
    box.add(records.position(i));
  }
  return box;
}

} // namespace pointfront
