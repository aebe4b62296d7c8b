#pragma once

#include "pointfront/Style/FrameShading.h"
#include "pointfront/Style/LayerStyle.h"

#include <cstdint>
#include <vector>

namespace pointfront
{
struct StyleSheet;

/// How the pixels of a complete style are shaded, as far as it says, else by its sheet's `shading`.
/// Where neither asks for light, spheres are lit all the same (LAYERS-5).
FrameLook lookOf(const LayerStyle& style, const FrameShading& shading);

/// The looks of a sheet and of its lenses, each once: that of the default is number 0.
/// Threads  a value.
class StyleLooks
{
public:
  explicit StyleLooks(const StyleSheet& sheet);

  /// Number of a complete style of the sheet or of one of its lenses.
  std::uint16_t numberOf(const LayerStyle& style) const;
  const std::vector<FrameLook>& looks() const { return looks_; }
  /// Numbers of all styles in order: the default, the classes, then the same of each lens.
  const std::vector<std::uint16_t>& numbers() const { return numbers_; }

private:
  void addAll(const StyleSheet& sheet);
  void add(const LayerStyle& style);

  FrameShading shading_;
  std::vector<FrameLook> looks_;
  std::vector<std::uint16_t> numbers_;
};

} // namespace pointfront
