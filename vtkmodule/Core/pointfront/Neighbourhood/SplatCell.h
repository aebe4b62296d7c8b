#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// What is around a point: places, as seen from it, nearest first, each once, without its own.
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
  /// Only what is nearer can still be kept.
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

/// The plane of a neighbourhood, and how far it is one. Eigenvalues are of the covariance.
struct NeighbourPlane
{
  glm::dvec3 normal{ 0.0, 0.0, 1.0 }; ///< of length 1; its sign has no meaning
  double flatness = 1.0; ///< smallest eigenvalue over the sum: 0 a plane, 1/3 a ball
  double width = 0.0;    ///< middle eigenvalue over the largest: 0 a line
};

/// Of the point and its neighbours.
NeighbourPlane neighbourPlane(const NearOffsets& near);

/// How large a disc at a point must be for the surface to close, from its nearest places:
/// 1.25 times the distance to the farthest vertex of its Voronoi cell among them in the plane,
/// within bounds; less on lines and in volumes.
/// Bounds   are multiples of the local scale, which is the median distance to the neighbours times
///          a constant: it depends on them only, not on where a cloud is cut into parts.
/// Result   finite, > 0; 0 without a neighbour. Units of the offsets.
/// Source   splat rule and constants: docs/adr/0017-splat-radius.md.
/// `rim`, if it is asked for: whether the cell is open, so that the radius is a guess.
double splatRadius(
  const NearOffsets& near, const NeighbourPlane& plane, bool* rim = nullptr);

} // namespace pointfront
