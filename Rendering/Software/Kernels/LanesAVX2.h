#pragma once

#include "LanesX86.h"

namespace pointfront
{
namespace
{

// LanesPortable.h with AVX2.

struct LaneMask
{
  __m256 v;
};

inline LaneMask operator<=(Lanes a, Lanes b)
{
  return { _mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ) };
}
inline LaneMask operator&(LaneMask a, LaneMask b)
{
  return { _mm256_and_ps(a.v, b.v) };
}
inline LaneMask operator|(LaneMask a, LaneMask b)
{
  return { _mm256_or_ps(a.v, b.v) };
}
inline bool any(LaneMask m)
{
  return _mm256_movemask_ps(m.v) != 0;
}
inline Lanes choose(LaneMask m, Lanes a, Lanes b)
{
  return { _mm256_blendv_ps(b.v, a.v, m.v) };
}

inline void keepNearest4(RasterKey* keys, __m128i depthBits, __m256i index, __m128i m)
{
  const __m256i old = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(keys));
  const __m256i key =
    _mm256_or_si256(_mm256_slli_epi64(_mm256_cvtepu32_epi64(depthBits), 32), index);
  const __m256i nearer = _mm256_and_si256(_mm256_cmpgt_epi64(old, key), _mm256_cvtepi32_epi64(m));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(keys), _mm256_blendv_epi8(old, key, nearer));
}
inline void keepNearest4x2(
  RasterKey* lower, RasterKey* upper, Lanes depth, std::uint32_t index, LaneMask m)
{
  const __m256i bits = _mm256_castps_si256(depth.v);
  const __m256i mask = _mm256_castps_si256(m.v);
  const __m256i low = _mm256_set1_epi64x(static_cast<long long>(index));
  keepNearest4(lower, _mm256_castsi256_si128(bits), low, _mm256_castsi256_si128(mask));
  keepNearest4(upper, _mm256_extracti128_si256(bits, 1), low, _mm256_extracti128_si256(mask, 1));
}
inline void keepNearest8(RasterKey* keys, Lanes depth, std::uint32_t index, LaneMask m)
{
  keepNearest4x2(keys, keys + 4, depth, index, m);
}

/// `count` pixels of a row, at most four: the others get what they have.
inline void keepRow4(RasterKey* keys, float depth, std::uint32_t index, int count)
{
  const __m128i bits = _mm_castps_si128(_mm_set1_ps(depth));
  const __m128i m = _mm_cmplt_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(count));
  keepNearest4(keys, bits, _mm256_set1_epi64x(static_cast<long long>(index)), m);
}
inline LaneMask equal8(const std::int32_t* values, std::int32_t wanted)
{
  const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values));
  return { _mm256_castsi256_ps(_mm256_cmpeq_epi32(eight, _mm256_set1_epi32(wanted))) };
}

/// For each mask of eight lanes: its lanes, one after the other, a byte each.
struct LanesOfMask
{
  constexpr LanesOfMask()
    : packed()
  {
    for (unsigned mask = 0; mask < 256; ++mask)
    {
      unsigned place = 0;
      for (unsigned lane = 0; lane < 8; ++lane)
      {
        if ((mask >> lane & 1u) != 0)
        {
          packed[mask] |= std::uint64_t(lane) << (8 * place++);
        }
      }
    }
  }
  std::uint64_t packed[256];
};
constexpr LanesOfMask lanesOfMask;

inline int listFragments(RasterBatch& batch, int listed, const std::int32_t* offsets,
  std::int32_t further, Lanes depth, std::uint32_t index, LaneMask m)
{
  const auto mask = static_cast<unsigned>(_mm256_movemask_ps(m.v));
  const __m256i lanes = _mm256_cvtepu8_epi32(
    _mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanesOfMask.packed + mask)));
  const __m256i offset = _mm256_add_epi32(
    _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets)), _mm256_set1_epi32(further));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(batch.fragmentOffset + listed),
    _mm256_permutevar8x32_epi32(offset, lanes));
  _mm256_storeu_ps(batch.fragmentDepth + listed, _mm256_permutevar8x32_ps(depth.v, lanes));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(batch.fragmentIndex + listed),
    _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(index))));
  return listed + __builtin_popcount(mask);
}

inline LaneWeights weights(Lanes x, LaneMask m)
{
  return { _mm256_and_si256(_mm256_cvttps_epi32(x.v), _mm256_castps_si256(m.v)) };
}

struct LaneColour
{
  __m256i v; ///< r, g, b, 1 twice
};
inline LaneColour colourOf(std::uint32_t rgba)
{
  const __m128i bytes = _mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(rgba)));
  const __m128i three = _mm_and_si128(bytes, _mm_setr_epi32(255, 255, 255, 0));
  const __m128i withOne = _mm_or_si128(three, _mm_setr_epi32(0, 0, 0, 1));
  return { _mm256_broadcastsi128_si256(withOne) };
}
inline void addTwo(std::uint32_t* sums, __m256i w, __m256i places, __m256i colour)
{
  auto* const p = reinterpret_cast<__m256i*>(sums);
  // Weights and colours fit 16 bits: one multiply-add instruction instead of a 32-bit product.
  const __m256i added = _mm256_madd_epi16(_mm256_permutevar8x32_epi32(w, places), colour);
  _mm256_storeu_si256(p, _mm256_add_epi32(_mm256_loadu_si256(p), added));
}
inline void addSums4x2(std::uint32_t* lower, std::uint32_t* upper, LaneWeights w, LaneColour colour)
{
  addTwo(lower, w.v, _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1), colour.v);
  addTwo(lower + 8, w.v, _mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3), colour.v);
  addTwo(upper, w.v, _mm256_setr_epi32(4, 4, 4, 4, 5, 5, 5, 5), colour.v);
  addTwo(upper + 8, w.v, _mm256_setr_epi32(6, 6, 6, 6, 7, 7, 7, 7), colour.v);
}
inline void addSums8(std::uint32_t* sums, LaneWeights w, LaneColour colour)
{
  addSums4x2(sums, sums + 16, w, colour);
}
inline void addSums2(std::uint32_t* sums, const float* nearest, const float* depths,
  const std::int32_t* w, LaneColour colour)
{
  auto* const p = reinterpret_cast<__m256i*>(sums);
  const __m256i added = _mm256_madd_epi16(twoWeights(nearest, depths, w), colour.v);
  _mm256_storeu_si256(p, _mm256_add_epi32(_mm256_loadu_si256(p), added));
}

inline int listEqual(const std::int32_t* values, int count, std::int32_t wanted, std::int32_t* list)
{
  const __m256i all = _mm256_set1_epi32(wanted);
  int listed = 0;
  for (int first = 0; first < count; first += 8)
  {
    const __m256i eight = _mm256_load_si256(reinterpret_cast<const __m256i*>(values + first));
    auto found = static_cast<unsigned>(
      _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(eight, all))));
    found &= count - first >= 8 ? 255u : (1u << (count - first)) - 1u;
    for (; found != 0; found &= found - 1)
    {
      list[listed++] = first + __builtin_ctz(found);
    }
  }
  return listed;
}

} // namespace
} // namespace pointfront
