#pragma once

#include "pointfront/Neighbourhood/FourLanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

namespace pointfront
{

/// The polar dual of a point's cell: neighbour p is q = 2 p / |p|^2, and v is in the cell where no
/// v . q is more than 1. Seen in a direction the cell ends at the line of the largest q; where that
/// is another one in the next direction there is a vertex between them, if no third line cuts it
/// off. No branch depends on the lines but for that: a third of the time of cutting.
class DualCell
{
public:
  /// Neighbours in the plane; those behind `count` are set far away.
  DualCell(std::array<FourFloats, 4> x, std::array<FourFloats, 4> y)
  {
    for (std::size_t f = 0; f < x.size(); ++f)
    {
      const FourFloats squared = x[f] * x[f] + y[f] * y[f];
      tooNear_ = tooNear_ || bitsOf(squared < leastSquared) != 0;
      const FourFloats share = 2.0f / squared;
      x[f] *= share;
      y[f] *= share;
    }
    std::memcpy(x_.data(), x.data(), sizeof x);
    std::memcpy(y_.data(), y.data(), sizeof y);
  }

  /// Squared distance of the farthest vertex. Nothing for a cell that is open or reaches
  /// `mostReach`, and where float does not tell lines apart.
  std::optional<float> farthestVertex() const
  {
    std::array<std::uint8_t, directions + 1> lines;
    if (tooNear_ || !findLines(lines))
    {
      return std::nullopt;
    }
    std::array<Vertex, directions> vertices;
    std::size_t count = 0;
    for (std::size_t k = 0; k < directions; ++k)
    {
      vertices[count] = { lines[k], lines[k + 1], 0.0f };
      count += lines[k] != lines[k + 1] ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!meet(vertices[i]))
      {
        return std::nullopt;
      }
    }
    for (int cuts = 0; cuts < mostCuts; ++cuts)
    {
      const auto farthest = std::max_element(vertices.begin(), vertices.begin() + count,
        [](const Vertex& a, const Vertex& b) { return a.squared < b.squared; });
      const int third = cutOffBy(*farthest);
      if (third < 0)
      {
        return farthest->squared < mostReach * mostReach ? std::optional<float>(farthest->squared)
                                                         : std::nullopt;
      }
      if (count == vertices.size())
      {
        return std::nullopt;
      }
      Vertex& other = vertices[count++];
      other = { static_cast<std::uint8_t>(third), farthest->to, 0.0f };
      farthest->to = static_cast<std::uint8_t>(third);
      if (!meet(*farthest) || !meet(other))
      {
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

private:
  static constexpr std::size_t directions = 16;
  static constexpr float leastSquared = 1e-8f;
  static constexpr float mostReach = 1.99f;
  static constexpr float leastAngle = 1e-3f; ///< between lines that meet
  static constexpr float rounding = 1e-5f;
  static constexpr int mostCuts = 8;
  struct Vertex
  {
    std::uint8_t from; ///< line that it is on, and the next one counter-clockwise
    std::uint8_t to;
    float squared; ///< distance
  };

  /// In each direction, and the first once more. False where there is none.
  bool findLines(std::array<std::uint8_t, directions + 1>& lines) const
  {
    // cos and sin of 0, 22.5 ... 157.5 degrees; the others are opposite.
    constexpr float a = 0.92387953f;
    constexpr float b = 0.70710678f;
    constexpr float c = 0.38268343f;
    constexpr FourFloats cosines[2] = { { 1.0f, a, b, c }, { 0.0f, -c, -b, -a } };
    constexpr FourFloats sines[2] = { { 0.0f, c, b, a }, { 1.0f, a, b, c } };
    FourFloats most[2] = { FourFloats{}, FourFloats{} };
    FourFloats least[2] = { FourFloats{}, FourFloats{} };
    for (std::int32_t i = 0; i < 16; ++i)
    {
      const FourFloats x = fourTimes(x_[static_cast<std::size_t>(i)]);
      const FourFloats y = fourTimes(y_[static_cast<std::size_t>(i)]);
      for (std::size_t f = 0; f < 2; ++f)
      {
        // The last four bits say which line it is.
        const FourFloats along = cosines[f] * x + sines[f] * y;
        FourLanes bits;
        std::memcpy(&bits, &along, sizeof bits);
        bits = (bits & ~15) | i;
        FourFloats numbered;
        std::memcpy(&numbered, &bits, sizeof numbered);
        most[f] = most[f] > numbered ? most[f] : numbered;
        least[f] = least[f] < numbered ? least[f] : numbered;
      }
    }
    std::array<std::int32_t, directions> numbers;
    std::memcpy(numbers.data(), most, sizeof most);
    std::memcpy(numbers.data() + directions / 2, least, sizeof least);
    bool found = true;
    for (std::size_t k = 0; k < directions; ++k)
    {
      lines[k] = static_cast<std::uint8_t>(numbers[k] & 15);
      found = found && (numbers[k] & ~(15 | 1 << 31)) != 0;
    }
    lines[directions] = lines[0];
    return found;
  }

  /// False where two lines do not meet, or nearly not.
  bool meet(Vertex& vertex) const
  {
    const float ax = x_[vertex.from];
    const float ay = y_[vertex.from];
    const float bx = x_[vertex.to];
    const float by = y_[vertex.to];
    const float cross = ax * by - ay * bx;
    const float lengths = (ax * ax + ay * ay) * (bx * bx + by * by);
    vertex.squared = ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)) / (cross * cross);
    return cross > 0.0f && cross * cross > leastAngle * leastAngle * lengths;
  }

  /// The line that cuts most off; -1: none.
  int cutOffBy(const Vertex& vertex) const
  {
    const float ax = x_[vertex.from];
    const float ay = y_[vertex.from];
    const float bx = x_[vertex.to];
    const float by = y_[vertex.to];
    const float share = 1.0f / (ax * by - ay * bx);
    const FourFloats vx = fourTimes((by - ay) * share);
    const FourFloats vy = fourTimes((ax - bx) * share);
    std::array<float, 16> along;
    std::size_t beyond = 0;
    for (std::size_t f = 0; f < 4; ++f)
    {
      const FourFloats four = fourFrom(&x_[4 * f]) * vx + fourFrom(&y_[4 * f]) * vy;
      std::memcpy(&along[4 * f], &four, sizeof four);
      beyond |= bitsOf(four > 1.0f + rounding) << (4 * f);
    }
    if (beyond == 0)
    {
      return -1;
    }
    return static_cast<int>(std::max_element(along.begin(), along.end()) - along.begin());
  }

  std::array<float, 16> x_; ///< coordinates of the lines, one a neighbour
  std::array<float, 16> y_;
  bool tooNear_ = false;
};

} // namespace pointfront
