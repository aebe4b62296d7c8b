#pragma once

#include "SplatSamples.h"

namespace pointfront
{
namespace
{

// Splats within 2 x 2 pixels: far views are made of them. Eight splats at a time are sampled at
// their four pixels, then each is put into the buffers.

/// Weights (1 - q)^2 in 6 bits: 267,000 splats on a pixel before a sum could overflow.
inline LaneWeights weightsOf(const SplatSample& s, Lanes centre, LaneMask added)
{
  const Lanes fall = all(1.0f) - s.q;
  return weights(fall * fall * centre + all(0.5f), added);
}

/// Draws the depths that decide who is seen.
template <bool Rimmed>
struct KeyDepth
{
  KeyDepth(const SplatPass& pass, Lanes radius)
    : back(all(pass.paraboloid) * radius)
    , rim(all(pass.rimRadii) * radius)
    , rimFrom(all(pass.rimFrom))
  {
  }
  Lanes operator()(const SplatSample& s) const
  {
    const Lanes key = s.depth + back * s.q;
    return Rimmed ? choose(s.q <= rimFrom, key, key + rim) : key;
  }
  Lanes back, rim, rimFrom;
};

template <SplatShape Shape, bool Parallel, typename Take>
inline void sampleTiny(const RasterCamera& camera, const SplatPass& pass, const RasterBatch& batch,
  int count, const Take& take)
{
  for (int first = 0; first < count; first += 8)
  {
    const LaneMask tiny = equal8(batch.extent + first, RasterBatch::Within2);
    if (!any(tiny))
    {
      continue;
    }
    const EightSplats eight{ first };
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, eight);
    const Lanes left = eight(batch.firstX), low = eight(batch.firstY);
    const Lanes right = left + all(1.0f), high = low + all(1.0f);
    const SplatSample samples[4] = { splat.at(left, low), splat.at(right, low),
      splat.at(left, high), splat.at(right, high) };
    take(eight, tiny, samples);
  }
}

inline int listTiny(RasterBatch& batch, int count)
{
  return listEqual(batch.extent, count, RasterBatch::Within2, batch.list);
}

/// The pixels that are covered are listed first, then drawn one after the other: loads of one size
/// from where a store of that size went do not wait for it.
template <SplatShape Shape, bool Parallel, bool Rimmed>
void drawTiny(const RasterCamera& camera, const SplatPass& pass, RasterBatch& batch, int count,
  std::int32_t stride, std::uint32_t index, RasterKey* keys)
{
  int listed = 0;
  sampleTiny<Shape, Parallel>(camera, pass, batch, count,
    [&](EightSplats eight, LaneMask tiny, const SplatSample(&samples)[4])
    {
      const KeyDepth<Rimmed> keyDepth(pass, eight(batch.radius));
      const std::int32_t further[4] = { 0, 1, stride, stride + 1 };
      const std::uint32_t id = index + static_cast<std::uint32_t>(eight.first);
      for (int corner = 0; corner < 4; ++corner)
      {
        const SplatSample& s = samples[corner];
        listed = listFragments(batch, listed, batch.offset + eight.first, further[corner],
          keyDepth(s), id, s.covered & tiny);
      }
    });
  for (int i = 0; i < listed; ++i)
  {
    std::uint32_t bits;
    __builtin_memcpy(&bits, batch.fragmentDepth + i, 4);
    batch.fragmentKey[i] =
      static_cast<RasterKey>(std::uint64_t(bits) << 32 | batch.fragmentIndex[i]);
  }
  for (int i = 0; i < listed; ++i)
  {
    RasterKey* const pixel = keys + batch.fragmentOffset[i];
    const RasterKey key = batch.fragmentKey[i], old = *pixel;
    *pixel = key < old ? key : old;
  }
}

template <SplatShape Shape, bool Parallel>
void addTiny(const RasterCamera& camera, const SplatPass& pass, RasterBatch& batch, int count,
  std::int32_t stride, const float* nearest, std::uint32_t* sums)
{
  const int tiny = listTiny(batch, count);
  if (tiny == 0)
  {
    return;
  }
  const Lanes nothing = all(notDrawn());
  const Lanes pixelSize = all(pass.slackPixels / camera.scaleY);
  sampleTiny<Shape, Parallel>(camera, pass, batch, count,
    [&](EightSplats eight, LaneMask, const SplatSample(&samples)[4])
    {
      const SplatSample& a = samples[0];
      const SplatSample& b = samples[1];
      const SplatSample& c = samples[2];
      const SplatSample& d = samples[3];
      const Lanes radius = eight(batch.radius), centre = eight(batch.weight);
      const Lanes rim = all(pass.paraboloid) * radius;
      const Lanes reach = Parallel ? all(1.0f) : eight(batch.depth);
      const Lanes slack = all(pass.slackRadii) * radius + pixelSize * reach;
      const auto front = [&](const SplatSample& s)
      { return choose(s.covered, s.depth + rim * s.q - slack, nothing); };
      storePairs(batch.lowerDepth + 2 * eight.first, front(a), front(b));
      storePairs(batch.upperDepth + 2 * eight.first, front(c), front(d));
      storePairs(batch.lowerWeight + 2 * eight.first, weightsOf(a, centre, a.covered),
        weightsOf(b, centre, b.covered));
      storePairs(batch.upperWeight + 2 * eight.first, weightsOf(c, centre, c.covered),
        weightsOf(d, centre, d.covered));
    });
  for (int i = 0; i < tiny; ++i)
  {
    const int j = batch.list[i];
    const std::int64_t lower = batch.offset[j], upper = lower + stride;
    const LaneColour colour = colourOf(batch.colour[j]);
    addSums2(sums + 4 * lower, nearest + lower, batch.lowerDepth + 2 * j, batch.lowerWeight + 2 * j,
      colour);
    addSums2(sums + 4 * upper, nearest + upper, batch.upperDepth + 2 * j, batch.upperWeight + 2 * j,
      colour);
  }
}

} // namespace
} // namespace pointfront
