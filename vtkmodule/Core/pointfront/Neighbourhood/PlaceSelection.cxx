#include "pointfront/Neighbourhood/PlaceSelection.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <numeric>

namespace pointfront
{
namespace
{
/// To find a limit with the number of places that is wanted; ties have none.
constexpr int mostSteps = 10;
/// The time of ranking by counting grows with the square.
constexpr std::size_t mostCounted = 64;
/// In the place of a float's last bits: its number among those ranked. So no two are equal.
constexpr std::int32_t numberBits = 0x3f;
} // namespace

void PlaceBall::resize(std::size_t count)
{
  places.resize(count);
  x.resize(count);
  y.resize(count);
  z.resize(count);
}

/// Ends with distances beyond any limit, so that four at a time can be compared.
void PlaceSelection::Distances::close(std::size_t number)
{
  count = number;
  std::fill_n(squared.begin() + static_cast<std::ptrdiff_t>(number), 4,
    std::numeric_limits<float>::infinity());
}

void PlaceSelection::measure(const PlaceBall& ball, const glm::dvec3& from, unsigned axes)
{
  const std::size_t count = ball.places.size();
  if (selected_.size() < count + 1)
  {
    measured_.squared.resize(count + 4);
    distances_.squared.resize(count + 4);
    selected_.resize(count + 1);
    order_.resize(count);
  }
  const glm::vec3 at(from - ball.origin);
  const float atX = at.x;
  const float atY = at.y;
  const float atZ = axes > 2 ? at.z : 0.0f;
  const float* const x = ball.x.data();
  const float* const y = ball.y.data();
  const float* const z = ball.z.data();
  float* const squared = measured_.squared.data();
  for (std::size_t i = 0; i < count; ++i)
  {
    const float dx = x[i] - atX;
    const float dy = y[i] - atY;
    const float dz = z[i] - atZ;
    squared[i] = dx * dx + dy * dy + dz * dz;
  }
  measured_.close(count);
}

void PlaceSelection::select(float limit)
{
  limit_ = limit;
  const float* const all = measured_.squared.data();
  std::uint32_t* const selected = selected_.data();
  const std::size_t count = measured_.count;
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    selected[next] = static_cast<std::uint32_t>(i);
    next += all[i] <= limit ? 1 : 0;
  }
  float* const squared = distances_.squared.data();
  for (std::size_t i = 0; i < next; ++i)
  {
    squared[i] = all[selected[i]];
  }
  distances_.close(next);
}

void PlaceSelection::narrow(float limit)
{
  float* const squared = distances_.squared.data();
  const std::size_t count = distances_.count;
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float distance = squared[i];
    selected_[next] = selected_[i];
    squared[next] = distance;
    next += distance <= limit ? 1 : 0;
  }
  distances_.close(next);
}

/// The search goes on as the number of places grows on a surface: with the squared distance. Two or
/// three steps are usual.
float PlaceSelection::limitOf(
  const Distances& distances, std::size_t fewest, std::size_t most, float likely)
{
  const float aim = 0.5f * float(fewest + most);
  float low = 0.0f;
  float high = everything;
  float below = 0.0f;  // places within the low limit
  float above = -1.0f; // and within the high one, if it is known
  float limit = likely;
  for (int step = 0; step < mostSteps; ++step)
  {
    const std::size_t within = countWithin(distances, limit);
    if (within >= fewest && within <= most)
    {
      return limit;
    }
    if (within < fewest)
    {
      low = limit;
      below = float(within);
    }
    else
    {
      high = limit;
      above = float(within);
    }
    limit = above < 0.0f ? limit * (aim + 1.0f) / (below + 0.5f)
                         : low + (high - low) * (aim + 0.5f - below) / (above - below + 1.0f);
  }
  return std::min(high, everything);
}

std::size_t PlaceSelection::countWithin(const Distances& distances, float limit)
{
  const float* const squared = distances.squared.data();
  std::int32_t within = 0;
  for (std::size_t i = 0; i < distances.count; i += 4)
  {
    for (std::size_t lane = 0; lane < 4; ++lane)
    {
      within += squared[i + lane] <= limit ? 1 : 0;
    }
  }
  return static_cast<std::size_t>(within);
}

/// Each one's rank is counted: for the twenty there usually are that is faster than a sort, as
/// nothing in it depends on a comparison.
void PlaceSelection::rank()
{
  const std::size_t count = size();
  const float* const squared = distances_.squared.data();
  std::uint32_t* const order = order_.data();
  if (count > mostCounted)
  {
    std::iota(order, order + count, 0u);
    std::sort(order, order + count,
      [squared](std::uint32_t a, std::uint32_t b) { return squared[a] < squared[b]; });
    return;
  }
  // Floats that are not negative are in order as integers. In fours; none is above the last ones.
  std::array<std::int32_t, mostCounted> keys;
  std::array<std::int32_t, mostCounted> ranks{};
  keys.fill(std::numeric_limits<std::int32_t>::max());
  for (std::size_t i = 0; i < count; ++i)
  {
    std::int32_t bits = 0;
    std::memcpy(&bits, &squared[i], sizeof bits);
    keys[i] = (bits & ~numberBits) | static_cast<std::int32_t>(i);
  }
  const std::size_t padded = (count + 3) / 4 * 4;
  for (std::size_t other = 0; other < count; ++other)
  {
    const std::int32_t key = keys[other];
    for (std::size_t i = 0; i < padded; ++i)
    {
      ranks[i] += keys[i] > key ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    order[static_cast<std::size_t>(ranks[i])] = static_cast<std::uint32_t>(i);
  }
}

} // namespace pointfront
