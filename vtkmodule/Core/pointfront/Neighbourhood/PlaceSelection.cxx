#include "pointfront/Neighbourhood/PlaceSelection.h"

#include "pointfront/Neighbourhood/FourLanes.h"

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
/// The time of sorting by counting grows with the square.
constexpr std::size_t mostCounted = 64;
/// In the place of a float's last bits: its number among those sorted. So no two are equal.
constexpr std::int32_t numberBits = 0x3f;

std::size_t padded(std::size_t count)
{
  return (count + 3) / 4 * 4;
}
} // namespace

void PlaceBall::resize(std::size_t count)
{
  places.resize(count);
  for (std::vector<float>* const axis : { &x, &y, &z })
  {
    axis->resize(padded(count));
    std::fill(axis->begin() + static_cast<std::ptrdiff_t>(count), axis->end(),
      std::numeric_limits<float>::infinity());
  }
}

/// Ends with distances beyond any limit, so that four or eight at a time can be compared.
void PlaceSelection::Distances::close(std::size_t number)
{
  count = number;
  std::fill_n(squared.begin() + static_cast<std::ptrdiff_t>(number), 8,
    std::numeric_limits<float>::infinity());
}

void PlaceSelection::measure(const PlaceBall& ball, const glm::dvec3& from, unsigned axes)
{
  const std::size_t count = ball.places.size();
  if (order_.size() < count + 8)
  {
    measured_.squared.resize(count + 8);
    distances_.squared.resize(count + 8);
    selected_.resize(count + 8);
    order_.resize(count + 8);
  }
  const glm::vec3 at(from - ball.origin);
  const float atX = at.x;
  const float atY = at.y;
  const float atZ = axes > 2 ? at.z : 0.0f;
  const float* const x = ball.x.data();
  const float* const y = ball.y.data();
  const float* const z = ball.z.data();
  float* const squared = measured_.squared.data();
  for (std::size_t i = 0; i < padded(count); ++i)
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
  const std::uint32_t* const selected = selected_.data();
  const FourFloats limits = fourTimes(limit);
  std::size_t count = 0;
  for (std::size_t i = 0; i < measured_.count; i += 4)
  {
    count += appendSet(
      fourFrom(all + i) <= limits, static_cast<std::int32_t>(i), selected_.data() + count);
  }
  float* const squared = distances_.squared.data();
  for (std::size_t i = 0; i < count; ++i)
  {
    squared[i] = all[selected[i]];
  }
  distances_.close(count);
}

/// Those before each are counted, as in sort().
std::optional<PlaceSelection::Gap> PlaceSelection::keepNearest(std::size_t wanted)
{
  const std::size_t count = size();
  if (count < wanted || count > mostToKeepFrom)
  {
    return std::nullopt;
  }
  float* const squared = distances_.squared.data();
  FourFloats last = fourTimes(0.0f);
  FourFloats next = fourTimes(everything);
  const auto most = static_cast<std::int32_t>(wanted);
  std::size_t kept = 0;
  const auto keep = [&](std::size_t first, const FourFloats& own, const FourLanes& nearer)
  {
    const FourLanes inner = nearer < most;
    last = inner && own > last ? own : last;
    next = !inner && own < next ? own : next;
    kept += appendSet(inner, static_cast<std::int32_t>(first), order_.data() + kept);
  };
  for (std::size_t i = 0; i < count; i += 8)
  {
    const FourFloats own = fourFrom(squared + i);
    const FourFloats own2 = fourFrom(squared + i + 4);
    FourLanes nearer{};
    FourLanes nearer2{};
    for (std::size_t other = 0; other < count; ++other)
    {
      const FourFloats distance = fourTimes(squared[other]);
      nearer -= distance < own;
      nearer2 -= distance < own2;
    }
    keep(i, own, nearer);
    keep(i + 4, own2, nearer2);
  }
  if (kept != wanted) // several at the distance of the last
  {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < kept; ++i)
  {
    selected_[i] = selected_[order_[i]];
    squared[i] = squared[order_[i]];
  }
  distances_.close(kept);
  return Gap{ std::max({ last[0], last[1], last[2], last[3] }),
    std::min({ next[0], next[1], next[2], next[3] }) };
}

/// The search goes on as the number of places grows on a surface: with the squared distance. Two or
/// three steps are usual.
float PlaceSelection::limitOf(
  const Distances& distances, std::size_t fewest, std::size_t most, float likely)
{
  const float aim = 0.5f * float(fewest + most);
  float low = 0.0f;
  float high = everything;
  float below = 0.0f; // places within the low limit
  float above = -1.0f; // and within the high one, if it is known
  float limit = likely;
  for (int step = 0; step < mostSteps; ++step)
  {
    limit = std::min(limit, everything);
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
  return high;
}

std::size_t PlaceSelection::countWithin(const Distances& distances, float limit)
{
  const float* const squared = distances.squared.data();
  const FourFloats limits = fourTimes(limit);
  FourLanes within{};
  for (std::size_t i = 0; i < distances.count; i += 4)
  {
    within -= fourFrom(squared + i) <= limits;
  }
  const auto all = within[0] + within[1] + within[2] + within[3];
  return static_cast<std::size_t>(all);
}

/// Those before each are counted: for the twenty there usually are that is faster than a sort, as
/// nothing in it depends on a comparison.
void PlaceSelection::sort()
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
  std::array<std::int32_t, mostCounted> before{};
  keys.fill(std::numeric_limits<std::int32_t>::max());
  for (std::size_t i = 0; i < count; ++i)
  {
    std::int32_t bits = 0;
    std::memcpy(&bits, &squared[i], sizeof bits);
    keys[i] = (bits & ~numberBits) | static_cast<std::int32_t>(i);
  }
  for (std::size_t other = 0; other < count; ++other)
  {
    const std::int32_t key = keys[other];
    for (std::size_t i = 0; i < padded(count); ++i)
    {
      before[i] += keys[i] > key ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    order[static_cast<std::size_t>(before[i])] = static_cast<std::uint32_t>(i);
  }
}

} // namespace pointfront
