#pragma once

#include "LanesX86.h"

namespace pointfront
{
namespace
{

// LanesPortable.h with AVX-512 (F, VL, DQ, BW): eight keys are one register.

struct LaneMask
{
  __mmask8 v;
};

inline LaneMask operator<=(Lanes a, Lanes b)
{
  return { _mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ) };
}
inline LaneMask operator&(LaneMask a, LaneMask b)
{
  return { static_cast<__mmask8>(a.v & b.v) };
}
inline LaneMask operator|(LaneMask a, LaneMask b)
{
  return { static_cast<__mmask8>(a.v | b.v) };
}
inline bool any(LaneMask m)
{
  return m.v != 0;
}
inline Lanes choose(LaneMask m, Lanes a, Lanes b)
{
  return { _mm256_mask_mov_ps(b.v, m.v, a.v) };
}

inline void keepNearest8(RasterKey* keys, Lanes depth, std::uint32_t index, LaneMask m)
{
  const __m512i key =
    _mm512_or_si512(_mm512_slli_epi64(_mm512_cvtepu32_epi64(_mm256_castps_si256(depth.v)), 32),
      _mm512_set1_epi64(static_cast<long long>(index)));
  const __m512i old = _mm512_loadu_si512(keys);
  _mm512_storeu_si512(keys, _mm512_mask_min_epi64(old, m.v, old, key));
}
inline void keepNearest4(RasterKey* keys, __m256i key, unsigned m)
{
  auto* const p = reinterpret_cast<__m256i*>(keys);
  const __m256i old = _mm256_loadu_si256(p);
  _mm256_storeu_si256(p, _mm256_mask_min_epi64(old, static_cast<__mmask8>(m), old, key));
}
inline void keepNearest4x2(
  RasterKey* lower, RasterKey* upper, Lanes depth, std::uint32_t index, LaneMask m)
{
  const __m512i key =
    _mm512_or_si512(_mm512_slli_epi64(_mm512_cvtepu32_epi64(_mm256_castps_si256(depth.v)), 32),
      _mm512_set1_epi64(static_cast<long long>(index)));
  keepNearest4(lower, _mm512_castsi512_si256(key), m.v & 15u);
  keepNearest4(upper, _mm512_extracti64x4_epi64(key, 1), static_cast<unsigned>(m.v) >> 4);
}

/// `count` pixels of a row, at most four.
inline void keepRow4(RasterKey* keys, float depth, std::uint32_t index, int count)
{
  std::uint32_t bits;
  __builtin_memcpy(&bits, &depth, 4);
  const __m256i key = _mm256_set1_epi64x(static_cast<long long>(std::uint64_t(bits) << 32 | index));
  keepNearest4(keys, key, (1u << count) - 1u);
}
inline LaneMask equal8(const std::int32_t* values, std::int32_t wanted)
{
  const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values));
  return { _mm256_cmpeq_epi32_mask(eight, _mm256_set1_epi32(wanted)) };
}
inline int listFragments(RasterBatch& batch, int listed, const std::int32_t* offsets,
  std::int32_t further, Lanes depth, std::uint32_t index, LaneMask m)
{
  const __m256i offset = _mm256_add_epi32(
    _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets)), _mm256_set1_epi32(further));
  const __m256i indices = _mm256_add_epi32(
    _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32(static_cast<int>(index)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(batch.fragmentOffset + listed),
    _mm256_maskz_compress_epi32(m.v, offset));
  _mm256_storeu_ps(batch.fragmentDepth + listed, _mm256_maskz_compress_ps(m.v, depth.v));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(batch.fragmentIndex + listed),
    _mm256_maskz_compress_epi32(m.v, indices));
  return listed + __builtin_popcount(m.v);
}

inline LaneWeights weights(Lanes x, LaneMask m)
{
  return { _mm256_maskz_cvttps_epi32(m.v, x.v) };
}

struct LaneColour
{
  __m512i v; ///< r, g, b, 1 four times
};
inline LaneColour colourOf(std::uint32_t rgba)
{
  const __m128i bytes = _mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(rgba)));
  const __m128i three = _mm_and_si128(bytes, _mm_setr_epi32(255, 255, 255, 0));
  const __m128i withOne = _mm_or_si128(three, _mm_setr_epi32(0, 0, 0, 1));
  return { _mm512_broadcast_i32x4(withOne) };
}
inline void addFour(std::uint32_t* sums, LaneWeights w, __m512i places, LaneColour colour)
{
  // Weights and colours fit 16 bits: one multiply-add instruction instead of a 32-bit product.
  const __m512i each = _mm512_permutexvar_epi32(places, _mm512_castsi256_si512(w.v));
  const __m512i added = _mm512_madd_epi16(each, colour.v);
  _mm512_storeu_si512(sums, _mm512_add_epi32(_mm512_loadu_si512(sums), added));
}
inline void addSums4x2(std::uint32_t* lower, std::uint32_t* upper, LaneWeights w, LaneColour colour)
{
  addFour(lower, w, _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3), colour);
  addFour(upper, w, _mm512_setr_epi32(4, 4, 4, 4, 5, 5, 5, 5, 6, 6, 6, 6, 7, 7, 7, 7), colour);
}
inline void addSums8(std::uint32_t* sums, LaneWeights w, LaneColour colour)
{
  addSums4x2(sums, sums + 16, w, colour);
}
inline void addSums2(std::uint32_t* sums, const float* nearest, const float* depths,
  const std::int32_t* w, LaneColour colour)
{
  auto* const p = reinterpret_cast<__m256i*>(sums);
  const __m256i added =
    _mm256_madd_epi16(twoWeights(nearest, depths, w), _mm512_castsi512_si256(colour.v));
  _mm256_storeu_si256(p, _mm256_add_epi32(_mm256_loadu_si256(p), added));
}

inline int listEqual(const std::int32_t* values, int count, std::int32_t wanted, std::int32_t* list)
{
  const __m512i all = _mm512_set1_epi32(wanted);
  __m512i places = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  int listed = 0;
  for (int first = 0; first < count; first += 16)
  {
    const unsigned inside = count - first >= 16 ? 0xffffu : (1u << (count - first)) - 1u;
    const __mmask16 found = _mm512_mask_cmpeq_epi32_mask(
      static_cast<__mmask16>(inside), _mm512_load_si512(values + first), all);
    _mm512_storeu_si512(list + listed, _mm512_maskz_compress_epi32(found, places));
    listed += __builtin_popcount(found);
    places = _mm512_add_epi32(places, _mm512_set1_epi32(16));
  }
  return listed;
}

} // namespace
} // namespace pointfront
