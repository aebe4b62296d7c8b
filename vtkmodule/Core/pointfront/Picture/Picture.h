#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// A picture in memory: red, green, blue and opacity in 8 bits each, row by row from the top.
struct Picture
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba; ///< 4 * width * height

  std::size_t pixels() const { return std::size_t(width) * height; }
  const std::uint8_t* pixel(std::uint32_t column, std::uint32_t row) const
  {
    return rgba.data() + 4 * (std::size_t(row) * width + column);
  }
};

} // namespace pointfront
