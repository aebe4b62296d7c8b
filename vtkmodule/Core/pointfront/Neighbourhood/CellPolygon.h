#pragma once

#include "pointfront/Neighbourhood/FourLanes.h"
#include "pointfront/Neighbourhood/SplatCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace pointfront
{

/// A point's Voronoi cell in its plane, cut from a square of 2 x 2 by its neighbours one after
/// another. In float: 16 codes of a radius are a doubling.
class CellPolygon
{
public:
  CellPolygon()
  {
    x_[0] = FourFloats{ -halfSide, halfSide, halfSide, -halfSide };
    y_[0] = FourFloats{ -halfSide, -halfSide, halfSide, halfSide };
  }

  /// By the line half way to a neighbour.
  void cut(float x, float y)
  {
    const float half = 0.5f * (x * x + y * y);
    if (!(half > 0.0f) || count_ > mostVertices - 2)
    {
      return;
    }
    std::array<FourFloats, fours> side; // > 0: nearer to the neighbour
    std::uint32_t beyond = 0;
    for (std::size_t f = 0; 4 * f < count_; ++f)
    {
      side[f] = x_[f] * x + y_[f] * y - half;
      beyond |= static_cast<std::uint32_t>(bitsOf(side[f] > 0.0f)) << (4 * f);
    }
    const std::uint32_t all = (1u << count_) - 1u;
    beyond &= all;
    if (beyond == 0 || beyond == all)
    {
      return;
    }
    // The polygon is convex: those beyond follow one another, round the end.
    const std::uint32_t before = (beyond << 1 | beyond >> (count_ - 1)) & all; // one has it before
    const auto begin = static_cast<std::size_t>(__builtin_ctz(~beyond & before & all)); // kept
    const auto end = static_cast<std::size_t>(__builtin_ctz(beyond & ~before & all)); // not
    std::array<FourFloats, fours> keptX;
    std::array<FourFloats, fours> keptY;
    std::size_t count = 0;
    const auto keep = [&](float vx, float vy)
    {
      keptX[count / 4][count % 4] = vx;
      keptY[count / 4][count % 4] = vy;
      ++count;
    };
    const auto at = [](const std::array<FourFloats, fours>& v, std::size_t i)
    { return v[i / 4][i % 4]; };
    const auto meet = [&](std::size_t from, std::size_t to)
    {
      const float share = at(side, from) / (at(side, from) - at(side, to));
      keep(at(x_, from) + share * (at(x_, to) - at(x_, from)),
        at(y_, from) + share * (at(y_, to) - at(y_, from)));
    };
    meet(begin == 0 ? count_ - 1 : begin - 1, begin);
    std::size_t last = begin;
    for (std::size_t i = begin; i != end; i = i + 1 == count_ ? 0 : i + 1)
    {
      keep(at(x_, i), at(y_, i));
      last = i;
    }
    meet(last, end);
    count_ = count;
    for (std::size_t f = 0; 4 * f < count_; ++f)
    {
      x_[f] = keptX[f];
      y_[f] = keptY[f];
    }
  }

  /// Squared distance of the farthest vertex.
  double squaredExtent() const
  {
    float squared = 0.0f;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const float x = x_[i / 4][i % 4];
      const float y = y_[i / 4][i % 4];
      squared = std::max(squared, x * x + y * y);
    }
    return static_cast<double>(squared);
  }

  struct Reach
  {
    float squared = 0.0f; ///< distance of the farthest vertex between points; 0: there is none
    bool open = false; ///< the cell reaches the square
  };
  Reach reach() const
  {
    Reach result;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const float x = x_[i / 4][i % 4];
      const float y = y_[i / 4][i % 4];
      const bool rim = std::max(std::abs(x), std::abs(y)) > 0.999f * halfSide;
      result.open = result.open || rim;
      result.squared = rim ? result.squared : std::max(result.squared, x * x + y * y);
    }
    return result;
  }

private:
  static constexpr float halfSide = 2.0f;
  static constexpr std::size_t mostVertices = 4 + NearOffsets::most + 1;
  static constexpr std::size_t fours = (mostVertices + 3) / 4;
  std::array<FourFloats, fours> x_; ///< coordinates of the vertices, counter-clockwise
  std::array<FourFloats, fours> y_;
  std::size_t count_ = 4;
};

} // namespace pointfront
