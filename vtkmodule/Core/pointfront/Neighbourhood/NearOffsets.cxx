#include "pointfront/Neighbourhood/NearOffsets.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Neighbourhood/FourLanes.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{
bool offsetLess(const glm::dvec3& a, const glm::dvec3& b)
{
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

double squaredLengthOf(const glm::dvec3& v)
{
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

} // namespace

double NearOffsets::squaredBound() const
{
  return count_ < most ? infinity : squaredDistance(most - 1);
}

void NearOffsets::add(const glm::dvec3& offset)
{
  const double squared = squaredLengthOf(offset);
  const auto before = [&](std::size_t i)
  {
    return squared != squaredDistance(i) ? squared < squaredDistance(i)
                                         : offsetLess(offset, (*this)[i]);
  };
  if (!(squared > 0.0) || (count_ == most && !before(most - 1)))
  {
    return;
  }
  std::size_t place = count_;
  while (place > 0 && before(place - 1))
  {
    --place;
  }
  if (place > 0 && (*this)[place - 1] == offset)
  {
    return; // a place is one neighbour, however many points it has
  }
  const std::size_t slot = count_ < most ? count_++ : order_[most - 1];
  for (std::size_t i = count_ - 1; i > place; --i)
  {
    order_[i] = order_[i - 1];
  }
  order_[place] = static_cast<std::uint8_t>(slot);
  x_[slot] = offset.x;
  y_[slot] = offset.y;
  z_[slot] = offset.z;
  squared_[slot] = squared;
}

bool NearOffsets::assignSorted(const glm::dvec3* offsets, std::size_t count)
{
  if (count > room)
  {
    return false;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    x_[i] = offsets[i].x;
    y_[i] = offsets[i].y;
    z_[i] = offsets[i].z;
    squared_[i] = squaredLengthOf(offsets[i]);
    largest = std::max(largest, squared_[i]);
  }
  // Keys of 27 bits of distance and 4 of number; each one's place is how many are less.
  const double scale = largest > 1e-290 ? double(1 << 27) * (1.0 - 1e-9) / largest : 0.0;
  alignas(16) std::array<std::int32_t, room> keys;
  keys.fill(std::numeric_limits<std::int32_t>::max());
  for (std::size_t i = 0; i < count; ++i)
  {
    keys[i] = static_cast<std::int32_t>(squared_[i] * scale) << 4 | static_cast<std::int32_t>(i);
  }
  std::array<FourLanes, room / 4> places{};
  std::array<FourLanes, room / 4> fours;
  std::memcpy(fours.data(), keys.data(), sizeof fours);
  for (const std::int32_t key : keys)
  {
    const FourLanes other{ key, key, key, key };
    for (std::size_t f = 0; f < fours.size(); ++f)
    {
      places[f] -= other < fours[f]; // true is -1
    }
  }
  std::array<std::int32_t, room> sorted{};
  for (std::size_t i = 0; i < count; ++i)
  {
    sorted[static_cast<std::size_t>(places[i / 4][i % 4])] = keys[i];
  }
  bool ties = false;
  for (std::size_t i = 1; i < count; ++i)
  {
    ties = ties || sorted[i] >> 4 == sorted[i - 1] >> 4;
  }
  if (ties)
  {
    return false;
  }
  const std::size_t own = count > 0 && !(squared_[sorted[0] & 15] > 0.0) ? 1 : 0;
  count_ = std::min(count - own, most);
  for (std::size_t i = 0; i < count_; ++i)
  {
    order_[i] = static_cast<std::uint8_t>(sorted[i + own] & 15);
  }
  return true;
}

void NearOffsets::project(const glm::dvec3& first, const glm::dvec3& second, float far,
  std::array<float, most + 1>& x, std::array<float, most + 1>& y) const
{
  for (std::size_t i = 0; i < room; ++i)
  {
    x[i] = static_cast<float>(x_[i] * first.x + y_[i] * first.y + z_[i] * first.z);
    y[i] = static_cast<float>(x_[i] * second.x + y_[i] * second.y + z_[i] * second.z);
  }
  std::uint32_t there = 0;
  for (std::size_t i = 0; i < count_; ++i)
  {
    there |= 1u << order_[i];
  }
  for (std::uint32_t absent = ~there & ((1u << room) - 1u); absent != 0; absent &= absent - 1u)
  {
    const auto slot = static_cast<std::size_t>(__builtin_ctz(absent));
    x[slot] = far;
    y[slot] = far;
  }
}

void NearOffsets::assign(const glm::dvec3* offsets, std::size_t count)
{
  if (assignSorted(offsets, count))
  {
    return;
  }
  begin();
  for (std::size_t i = 0; i < count; ++i)
  {
    add(offsets[i]);
  }
}

} // namespace pointfront
