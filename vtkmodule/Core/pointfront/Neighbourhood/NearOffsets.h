#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The places around a point as offsets from it: nearest first, each once, without the point's own
/// place.
/// Order    by distance, then by the offsets: the same whatever order they came in.
/// Threads  one a thread; begin() keeps nothing.
class NearOffsets
{
public:
  static constexpr std::size_t most = 15;

  void begin() { count_ = 0; }
  /// Keeps the nearest `most` of all that are added. The point's own place (0) is left out.
  void add(const glm::dvec3& offset);
  /// begin() and add() of each: much less time for up to 16, unless some are equally far.
  void assign(const glm::dvec3* offsets, std::size_t count);
  /// Only nearer places can still be kept.
  double squaredBound() const;

  std::size_t size() const { return count_; }
  glm::dvec3 operator[](std::size_t i) const { return at(order_[i]); }
  double squaredDistance(std::size_t i) const { return squared_[order_[i]]; }

  /// Where they are in a plane, in any order: `x` along `first`, `y` along `second`; `far` in both
  /// in the place of those that are not there.
  void project(const glm::dvec3& first, const glm::dvec3& second, float far,
    std::array<float, most + 1>& x, std::array<float, most + 1>& y) const;

private:
  static constexpr std::size_t room = most + 1; ///< the point itself is among those assigned
  /// False for more than 16, and where two are nearly equally far.
  bool assignSorted(const glm::dvec3* offsets, std::size_t count);
  glm::dvec3 at(std::size_t slot) const { return { x_[slot], y_[slot], z_[slot] }; }

  std::array<double, room> x_{}; ///< by slot
  std::array<double, room> y_{};
  std::array<double, room> z_{};
  std::array<double, room> squared_{};
  std::array<std::uint8_t, room> order_{}; ///< slots, nearest first
  std::size_t count_ = 0;
};

} // namespace pointfront
