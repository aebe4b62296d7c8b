#include "PicturePixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pointfront
{

void putBackground(const std::array<double, 3>& colour, SoftwareTarget& target)
{
  std::array<int, 3> behind{};
  std::transform(colour.begin(), colour.end(), behind.begin(),
    [](double channel) { return static_cast<int>(std::lround(255.0 * channel)); });
  for (std::uint32_t& pixel : target.rgba)
  {
    auto* const bytes = reinterpret_cast<std::uint8_t*>(&pixel);
    const int opacity = bytes[3];
    for (std::size_t channel = 0; opacity < 255 && channel < 3; ++channel)
    {
      const int mixed = opacity * bytes[channel] + (255 - opacity) * behind[channel];
      bytes[channel] = static_cast<std::uint8_t>((mixed + 127) / 255);
    }
    bytes[3] = 255;
  }
}

bool showsPoints(const SoftwareTarget& target)
{
  return std::any_of(target.depth.begin(), target.depth.end(),
    [](float depth) { return depth < std::numeric_limits<float>::infinity(); });
}

Result<void> appendRows(PNGWriter& png, const SoftwareTarget& target, int bottom, int top)
{
  const auto width = static_cast<std::size_t>(target.width);
  std::vector<std::uint8_t> row(3 * width);
  for (int y = top - 1; y >= bottom; --y)
  {
    const auto* from = reinterpret_cast<const std::uint8_t*>(
      target.rgba.data() + static_cast<std::size_t>(y) * width);
    for (std::size_t x = 0; x < width; ++x)
    {
      std::copy(from + 4 * x, from + 4 * x + 3, row.data() + 3 * x);
    }
    if (Result<void> written = png.append(row.data(), 1, 0); !written)
    {
      return written;
    }
  }
  return {};
}

Result<std::unique_ptr<PNGWriter>> pngOf(const std::string& path, const std::array<int, 2>& size)
{
  return PNGWriter::create(path,
    { static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1]) },
    PNGWriter::Pixels::RGB8);
}

} // namespace pointfront
