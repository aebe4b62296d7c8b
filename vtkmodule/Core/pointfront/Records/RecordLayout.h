#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pointfront
{

/// Where the values of one point lie in its packed record while a store is being built: three
/// 32-bit coordinates in tree steps, then the columns of the schema one after another.
/// Rows, not columns: a point is moved some five times before it is encoded, and a row is one copy
/// and one cache line where columns would be one for each attribute.
class RecordLayout
{
public:
  explicit RecordLayout(const AttributeSchema& schema)
    : bytes_(positionBytes)
  {
    for (const Attribute& attribute : schema)
    {
      offsets_.push_back(bytes_);
      bytes_ += attribute.bytes();
    }
  }

  static constexpr std::size_t positionBytes = 3 * sizeof(std::uint32_t);
  std::size_t bytes() const { return bytes_; } ///< size of one record
  std::size_t offset(std::size_t column) const { return offsets_[column]; }

private:
  std::size_t bytes_;
  std::vector<std::size_t> offsets_;
};

/// A position inside the tree: steps from the origin of the root cube.
using TreePosition = glm::u32vec3;

/// Records are packed, so they are not aligned.
inline TreePosition positionOf(const std::byte* record)
{
  TreePosition position;
  std::memcpy(&position, record, RecordLayout::positionBytes);
  return position;
}

inline void setPosition(std::byte* record, const TreePosition& position)
{
  std::memcpy(record, &position, RecordLayout::positionBytes);
}

/// A record from one place to another that does not overlap: no call, unlike a std::memcpy() of a
/// length that is not known when compiled.
inline void copyRecord(std::byte* to, const std::byte* from, std::size_t bytes)
{
  constexpr std::size_t word = 16;
  if (bytes < word) // a position and up to three bytes
  {
    std::memcpy(to, from, RecordLayout::positionBytes);
    for (std::size_t i = RecordLayout::positionBytes; i < bytes; ++i)
    {
      to[i] = from[i];
    }
    return;
  }
  for (std::size_t i = 0; i + word <= bytes; i += word)
  {
    std::memcpy(to + i, from + i, word);
  }
  std::memcpy(to + bytes - word, from + bytes - word, word); // once more what overlaps
}

/// A packed run of records that someone else owns.
struct RecordSpan
{
  const std::byte* data = nullptr;
  std::size_t stride = 0; ///< bytes of one record

  const std::byte* record(std::size_t i) const { return data + i * stride; }
  TreePosition position(std::size_t i) const { return positionOf(record(i)); }
};

/// The records numbered in `order`, one behind the other from `to` on; `seen(i, record)` is called
/// with each of them while it is near.
template <typename Seen>
void gatherRecords(const RecordSpan& records, const std::vector<std::uint32_t>& order,
  std::byte* to, const Seen& seen)
{
  constexpr std::size_t ahead = 12; // records lie anywhere in the part: ask for them early
  for (std::size_t i = 0; i < order.size(); ++i, to += records.stride)
  {
    __builtin_prefetch(records.record(order[std::min(i + ahead, order.size() - 1)]));
    const std::byte* record = records.record(order[i]);
    copyRecord(to, record, records.stride);
    seen(i, record);
  }
}

inline void gatherRecords(
  const RecordSpan& records, const std::vector<std::uint32_t>& order, std::byte* to)
{
  gatherRecords(records, order, to, [](std::size_t, const std::byte*) {});
}

} // namespace pointfront
