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

/// The values of a point on the GPU beside its position: streams of 4 bytes a point. A stream
/// exists only if a style reads it.
enum class GpuStream : std::uint8_t
{
  Value, ///< value of its colour
  Shape, ///< its normal and the code of its radius
  Size, ///< a radius of its own as a float, world units
  Height, ///< above the ground as a float, world units
  Lenses ///< and those behind it: as Value, for each set of styles but the first (valueSetOf)
};
/// Most lenses of a sheet that have streams, for the points inside them and for the points that
/// make their masks.
constexpr std::size_t gpuLenses = 4;
constexpr std::size_t gpuValueSets = 1 + 2 * gpuLenses;
constexpr std::size_t gpuStreamCount = std::size_t(GpuStream::Lenses) + gpuValueSets - 1;

/// Styles that draw each point once at most, and so have one value a point: those outside of
/// lenses (0), those inside one, those that make the mask of one. `style` is of the first lenses.
inline std::size_t valueSetOf(const ResolvedStyle& style)
{
  return style.lens < 0 ? 0 : 1 + 2 * std::size_t(style.lens) + (style.lensMask ? 1 : 0);
}
inline GpuStream valueStreamOf(std::size_t set)
{
  return set == 0 ? GpuStream::Value
                  : static_cast<GpuStream>(std::size_t(GpuStream::Lenses) + set - 1);
}

/// Which streams the styles of one layer read.
/// Marks    Where a set of styles has filters, several styles or combined colours, a point's value
///          is its final colour, made on the host, and alpha is the number of the style in its set.
struct GpuStreams
{
  std::array<bool, gpuStreamCount> wanted{};
  std::array<bool, gpuValueSets> marked{};

  bool has(GpuStream stream) const { return wanted[static_cast<std::size_t>(stream)]; }
  int count() const { return static_cast<int>(std::count(wanted.begin(), wanted.end(), true)); }
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
    std::array<int, gpuValueSets> counts{};
    for (const auto& style : styles)
    {
      if (style->lens >= static_cast<int>(gpuLenses))
      {
        continue; // is not drawn by OpenGL
      }
      const std::size_t set = valueSetOf(*style);
      const bool combined = style->second.combination != ColourCombination::None;
      bool& marked = streams.marked[set];
      bool& values = streams.wanted[std::size_t(valueStreamOf(set))];
      marked = marked || ++counts[set] > 1 || combined || !style->filter.empty();
      values = values || marked || style->colouring.hasValues();
      streams.wanted[1] = streams.wanted[1] || style->normalColumn || style->radiusColumn;
      streams.wanted[2] = streams.wanted[2] || style->size.mode == SplatSize::Mode::Attribute;
      streams.wanted[3] = streams.wanted[3] || style->heightColumn;
    }
    return streams;
  }
};

} // namespace pointfront
