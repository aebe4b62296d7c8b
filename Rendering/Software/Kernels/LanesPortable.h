#pragma once

#include "RasterBatch.h"

namespace pointfront
{
namespace
{

// Eight pixels at a time in plain C++. The other Lanes*.h have the same functions with intrinsics,
// and the same results.

struct Lanes
{
  float v[8];
};
struct LaneMask
{
  std::int32_t v[8]; ///< 0 or -1
};
struct LaneWeights
{
  std::int32_t v[8];
};

#define POINTFRONT_EACH_LANE(expression)                                                           \
  Lanes r;                                                                                         \
  for (int i = 0; i < 8; ++i)                                                                      \
  {                                                                                                \
    r.v[i] = (expression);                                                                         \
  }                                                                                                \
  return r

inline Lanes all(float x)
{
  POINTFRONT_EACH_LANE(x);
}
inline Lanes load8(const float* p)
{
  POINTFRONT_EACH_LANE(p[i]);
}
inline Lanes load4x2(const float* p, const float* q)
{
  POINTFRONT_EACH_LANE(i < 4 ? p[i] : q[i - 4]);
}
inline Lanes operator+(const Lanes& a, const Lanes& b)
{
  POINTFRONT_EACH_LANE(a.v[i] + b.v[i]);
}
inline Lanes operator-(const Lanes& a, const Lanes& b)
{
  POINTFRONT_EACH_LANE(a.v[i] - b.v[i]);
}
inline Lanes operator*(const Lanes& a, const Lanes& b)
{
  POINTFRONT_EACH_LANE(a.v[i] * b.v[i]);
}
inline Lanes operator/(const Lanes& a, const Lanes& b)
{
  POINTFRONT_EACH_LANE(a.v[i] / b.v[i]);
}
/// As the instruction: b where one is NaN.
inline Lanes smaller(const Lanes& a, const Lanes& b)
{
  POINTFRONT_EACH_LANE(a.v[i] < b.v[i] ? a.v[i] : b.v[i]);
}
inline Lanes larger(const Lanes& a, const Lanes& b)
{
  POINTFRONT_EACH_LANE(a.v[i] > b.v[i] ? a.v[i] : b.v[i]);
}
inline Lanes rootOf(const Lanes& a)
{
  POINTFRONT_EACH_LANE(__builtin_sqrtf(a.v[i]));
}
#undef POINTFRONT_EACH_LANE

inline LaneMask operator<=(const Lanes& a, const Lanes& b)
{
  LaneMask m;
  for (int i = 0; i < 8; ++i)
  {
    m.v[i] = a.v[i] <= b.v[i] ? -1 : 0;
  }
  return m;
}
inline LaneMask operator&(const LaneMask& a, const LaneMask& b)
{
  LaneMask m;
  for (int i = 0; i < 8; ++i)
  {
    m.v[i] = a.v[i] & b.v[i];
  }
  return m;
}
inline LaneMask operator|(const LaneMask& a, const LaneMask& b)
{
  LaneMask m;
  for (int i = 0; i < 8; ++i)
  {
    m.v[i] = a.v[i] | b.v[i];
  }
  return m;
}
inline bool any(const LaneMask& m)
{
  std::int32_t found = 0;
  for (int i = 0; i < 8; ++i)
  {
    found |= m.v[i];
  }
  return found != 0;
}
inline Lanes choose(const LaneMask& m, const Lanes& a, const Lanes& b)
{
  Lanes r;
  for (int i = 0; i < 8; ++i)
  {
    r.v[i] = m.v[i] ? a.v[i] : b.v[i];
  }
  return r;
}

inline RasterKey keyOf(float depth, std::uint32_t index)
{
  std::uint32_t bits;
  __builtin_memcpy(&bits, &depth, 4);
  return static_cast<RasterKey>(std::uint64_t(bits) << 32 | index);
}
inline void keepNearest(
  RasterKey* keys, const Lanes& depth, std::uint32_t index, const LaneMask& m, int from, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const RasterKey key = keyOf(depth.v[from + i], index);
    keys[i] = m.v[from + i] && key < keys[i] ? key : keys[i];
  }
}
inline void keepNearest8(
  RasterKey* keys, const Lanes& depth, std::uint32_t index, const LaneMask& m)
{
  keepNearest(keys, depth, index, m, 0, 8);
}
inline void keepNearest4x2(
  RasterKey* lower, RasterKey* upper, const Lanes& depth, std::uint32_t index, const LaneMask& m)
{
  keepNearest(lower, depth, index, m, 0, 4);
  keepNearest(upper, depth, index, m, 4, 4);
}

/// The mark of points that are not drawn: a NaN whose sign is set.
inline float notDrawn()
{
  const std::uint32_t bits = ~0u;
  float value;
  __builtin_memcpy(&value, &bits, 4);
  return value;
}
/// a0, b0, a1, b1 ... a7, b7
inline void storePairs(float* p, const Lanes& a, const Lanes& b)
{
  for (int i = 0; i < 8; ++i)
  {
    p[2 * i] = a.v[i];
    p[2 * i + 1] = b.v[i];
  }
}
inline void storePairs(std::int32_t* p, const LaneWeights& a, const LaneWeights& b)
{
  for (int i = 0; i < 8; ++i)
  {
    p[2 * i] = a.v[i];
    p[2 * i + 1] = b.v[i];
  }
}
/// `count` pixels of a row, at most four.
inline void keepRow4(RasterKey* keys, float depth, std::uint32_t index, int count)
{
  const RasterKey key = keyOf(depth, index);
  for (int i = 0; i < count; ++i)
  {
    keys[i] = key < keys[i] ? key : keys[i];
  }
}
/// Which of eight are `wanted`.
inline LaneMask equal8(const std::int32_t* values, std::int32_t wanted)
{
  LaneMask m;
  for (int i = 0; i < 8; ++i)
  {
    m.v[i] = values[i] == wanted ? -1 : 0;
  }
  return m;
}
/// Lists one pixel each of eight splats, numbered from `index`, those in the mask: behind the first
/// `listed` of the batch's fragments. Gives how many there are then.
inline int listFragments(RasterBatch& batch, int listed, const std::int32_t* offsets,
  std::int32_t further, const Lanes& depth, std::uint32_t index, const LaneMask& m)
{
  for (int i = 0; i < 8; ++i)
  {
    batch.fragmentOffset[listed] = offsets[i] + further;
    batch.fragmentDepth[listed] = depth.v[i];
    batch.fragmentIndex[listed] = index + static_cast<std::uint32_t>(i);
    listed += m.v[i] ? 1 : 0;
  }
  return listed;
}

/// Towards zero; 0 where the mask is.
inline LaneWeights weights(const Lanes& x, const LaneMask& m)
{
  LaneWeights w;
  for (int i = 0; i < 8; ++i)
  {
    w.v[i] = m.v[i] ? static_cast<std::int32_t>(x.v[i]) : 0;
  }
  return w;
}

struct LaneColour
{
  std::uint32_t v[4]; ///< r, g, b, 1
};
inline LaneColour colourOf(std::uint32_t rgba)
{
  return { { rgba & 255u, rgba >> 8 & 255u, rgba >> 16 & 255u, 1u } };
}
inline void addFour(std::uint32_t* sums, const std::int32_t* w, const LaneColour& colour)
{
  for (int i = 0; i < 4; ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      sums[4 * i + c] += static_cast<std::uint32_t>(w[i]) * colour.v[c];
    }
  }
}
inline void addSums8(std::uint32_t* sums, const LaneWeights& w, const LaneColour& colour)
{
  addFour(sums, w.v, colour);
  addFour(sums + 16, w.v + 4, colour);
}
inline void addSums4x2(
  std::uint32_t* lower, std::uint32_t* upper, const LaneWeights& w, const LaneColour& colour)
{
  addFour(lower, w.v, colour);
  addFour(upper, w.v + 4, colour);
}

/// Two pixels of a row: what is not behind `nearest` is added.
inline void addSums2(std::uint32_t* sums, const float* nearest, const float* depths,
  const std::int32_t* w, const LaneColour& colour)
{
  for (int i = 0; i < 2; ++i)
  {
    const std::uint32_t weight = depths[i] <= nearest[i] ? static_cast<std::uint32_t>(w[i]) : 0u;
    for (int c = 0; c < 4; ++c)
    {
      sums[4 * i + c] += weight * colour.v[c];
    }
  }
}

/// Which of the first `count` are `wanted`, in their order; how many.
inline int listEqual(const std::int32_t* values, int count, std::int32_t wanted, std::int32_t* list)
{
  int listed = 0;
  for (int j = 0; j < count; ++j)
  {
    list[listed] = j;
    listed += values[j] == wanted;
  }
  return listed;
}

} // namespace
} // namespace pointfront
