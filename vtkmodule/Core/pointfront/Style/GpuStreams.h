#pragma once

#include "pointfront/Style/ResolvedStyle.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// What a point has on the GPU beside its position: streams of 4 bytes a point, each there only
/// where a style reads it.
enum class GpuStream : std::uint8_t
{
  Value, ///< what its colour is made of
  Shape, ///< its normal and the code of its radius
  Size,  ///< a radius of its own as a float, world units
  Height ///< above the ground as a float, world units
};
constexpr std::size_t gpuStreamCount = 4;

/// Which streams the styles of one layer read.
/// Marks    Where a layer has filters, several styles or combined colours, a point's value is its
///          final colour, made on the host, and alpha is the number of the style that draws it.
struct GpuStreams
{
  std::array<bool, gpuStreamCount> wanted{};
  bool marked = false;

  bool has(GpuStream stream) const { return wanted[static_cast<std::size_t>(stream)]; }
  int count() const
  {
    return static_cast<int>(std::count(wanted.begin(), wanted.end(), true));
  }
  void add(const GpuStreams& other)
  {
    for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
    {
      wanted[stream] = wanted[stream] || other.wanted[stream];
    }
  }

  static GpuStreams of(const std::vector<std::shared_ptr<const ResolvedStyle>>& styles)
  {
    GpuStreams streams;
    streams.marked = styles.size() > 1;
    for (const auto& style : styles)
    {
      const bool combined = style->second.combination != ColourCombination::None;
      streams.marked = streams.marked || combined || !style->filter.empty();
      streams.wanted[0] = streams.wanted[0] || style->colouring.hasValues();
      streams.wanted[1] = streams.wanted[1] || style->normalColumn || style->radiusColumn;
      streams.wanted[2] = streams.wanted[2] || style->size.mode == SplatSize::Mode::Attribute;
      streams.wanted[3] = streams.wanted[3] || style->heightColumn;
    }
    streams.wanted[0] = streams.wanted[0] || streams.marked;
    return streams;
  }
};

} // namespace pointfront
