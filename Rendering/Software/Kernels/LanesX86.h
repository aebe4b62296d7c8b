#pragma once

#include "RasterBatch.h"

#include <immintrin.h>

namespace pointfront
{
namespace
{

// Arithmetic of LanesPortable.h, the same with AVX2 and AVX-512: eight floats are one register.

struct Lanes
{
  __m256 v;
};
struct LaneWeights
{
  __m256i v;
};

inline Lanes all(float x)
{
  return { _mm256_set1_ps(x) };
}
inline Lanes load8(const float* p)
{
  return { _mm256_loadu_ps(p) };
}
inline Lanes load4x2(const float* p, const float* q)
{
  return { _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p)), _mm_loadu_ps(q), 1) };
}
inline Lanes operator+(Lanes a, Lanes b)
{
  return { _mm256_add_ps(a.v, b.v) };
}
inline Lanes operator-(Lanes a, Lanes b)
{
  return { _mm256_sub_ps(a.v, b.v) };
}
inline Lanes operator*(Lanes a, Lanes b)
{
  return { _mm256_mul_ps(a.v, b.v) };
}
inline Lanes operator/(Lanes a, Lanes b)
{
  return { _mm256_div_ps(a.v, b.v) };
}
inline Lanes smaller(Lanes a, Lanes b)
{
  return { _mm256_min_ps(a.v, b.v) };
}
inline Lanes larger(Lanes a, Lanes b)
{
  return { _mm256_max_ps(a.v, b.v) };
}
inline Lanes rootOf(Lanes a)
{
  return { _mm256_sqrt_ps(a.v) };
}

inline float notDrawn()
{
  return _mm_cvtss_f32(_mm_castsi128_ps(_mm_set1_epi32(-1)));
}
inline void storePairs(float* p, Lanes a, Lanes b)
{
  const __m256 low = _mm256_unpacklo_ps(a.v, b.v), high = _mm256_unpackhi_ps(a.v, b.v);
  _mm256_storeu_ps(p, _mm256_permute2f128_ps(low, high, 0x20));
  _mm256_storeu_ps(p + 8, _mm256_permute2f128_ps(low, high, 0x31));
}
inline void storePairs(std::int32_t* p, LaneWeights a, LaneWeights b)
{
  const __m256i low = _mm256_unpacklo_epi32(a.v, b.v), high = _mm256_unpackhi_epi32(a.v, b.v);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permute2x128_si256(low, high, 0x20));
  _mm256_storeu_si256(
    reinterpret_cast<__m256i*>(p + 8), _mm256_permute2x128_si256(low, high, 0x31));
}

/// Two weights, 0 where the splat is behind; each four times.
inline __m256i twoWeights(const float* nearest, const float* depths, const std::int32_t* w)
{
  const __m128 front = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(depths)));
  const __m128 known = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(nearest)));
  const __m128i drawn = _mm_castps_si128(_mm_cmple_ps(front, known));
  const __m128i weights = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(w));
  return _mm256_permutevar8x32_epi32(_mm256_castsi128_si256(_mm_and_si128(weights, drawn)),
    _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1));
}

} // namespace
} // namespace pointfront
