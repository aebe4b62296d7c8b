#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace pointfront::test
{

/// Patterns of about `count` points in the unit square: one point has an area of 1 / count, whose
/// root is h.
class SplatPatterns
{
public:
  explicit SplatPatterns(std::uint64_t seed)
    : random_(seed)
  {
  }

  /// A maximal Poisson-disk sample, by darts.
  std::vector<glm::dvec3> blueNoise(std::size_t count)
  {
    const double distance = 0.78 / std::sqrt(static_cast<double>(count));
    const auto side = static_cast<std::size_t>(1.0 / distance) + 2;
    std::vector<std::vector<glm::dvec3>> cells(side * side);
    std::vector<glm::dvec3> points;
    for (std::size_t dart = 0; dart < 60 * count; ++dart)
    {
      const glm::dvec3 p(uniform(), uniform(), 0.0);
      const auto x = static_cast<std::size_t>(p.x / distance);
      const auto y = static_cast<std::size_t>(p.y / distance);
      bool crowded = false;
      for (std::size_t j = y - std::min<std::size_t>(y, 1); j <= std::min(y + 1, side - 1); ++j)
      {
        for (std::size_t i = x - std::min<std::size_t>(x, 1); i <= std::min(x + 1, side - 1); ++i)
        {
          for (const glm::dvec3& q : cells[j * side + i])
          {
            const double dx = q.x - p.x;
            const double dy = q.y - p.y;
            crowded = crowded || dx * dx + dy * dy < distance * distance;
          }
        }
      }
      if (!crowded)
      {
        cells[y * side + x].push_back(p);
        points.push_back(p);
      }
    }
    return points;
  }

  /// Lines of a scanner: `ratio` times as far apart as the points in them, with jitter of 8 %.
  std::vector<glm::dvec3> scanLines(std::size_t count, double ratio)
  {
    const double h = 1.0 / std::sqrt(static_cast<double>(count));
    const double along = h / std::sqrt(ratio);
    const double across = h * std::sqrt(ratio);
    std::vector<glm::dvec3> points;
    for (double y = 0.5 * across; y < 1.0; y += across)
    {
      for (double x = uniform() * along; x < 1.0; x += along)
      {
        points.emplace_back(x + 0.16 * along * (uniform() - 0.5),
          y + 0.06 * across * (uniform() - 0.5), 0.05 * h * (uniform() - 0.5));
      }
    }
    return points;
  }

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

private:
  std::mt19937_64 random_; // its numbers are the same everywhere
};

/// Share of the inner 80 % of the unit square that no disc of its radius around a point covers,
/// seen from above.
template <typename Radius>
double holesOf(const std::vector<glm::dvec3>& points, const Radius& radius)
{
  constexpr int side = 800;
  std::vector<std::uint8_t> covered(side * side, 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double r = radius(i);
    const auto pixel = [&](double v)
    { return std::clamp(static_cast<int>(v * side), 0, side - 1); };
    for (int y = pixel(points[i].y - r); y <= pixel(points[i].y + r); ++y)
    {
      for (int x = pixel(points[i].x - r); x <= pixel(points[i].x + r); ++x)
      {
        const double dx = (x + 0.5) / side - points[i].x;
        const double dy = (y + 0.5) / side - points[i].y;
        covered[static_cast<std::size_t>(y * side + x)] |= dx * dx + dy * dy <= r * r ? 1 : 0;
      }
    }
  }
  int holes = 0;
  for (int y = side / 10; y < side - side / 10; ++y)
  {
    for (int x = side / 10; x < side - side / 10; ++x)
    {
      holes += covered[static_cast<std::size_t>(y * side + x)] == 0 ? 1 : 0;
    }
  }
  return holes / (0.64 * side * side);
}

/// Share of a stored radius that decides depth (docs/adr/0017-splat-radius.md): that must cover.
constexpr double visibleShare = 0.85;

} // namespace pointfront::test
