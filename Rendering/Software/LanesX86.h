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

} // namespace
} // namespace pointfront
