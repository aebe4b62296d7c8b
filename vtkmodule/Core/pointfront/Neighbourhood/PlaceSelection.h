#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// Places around a middle, in float for a first selection four at a time.
struct PlaceBall
{
  glm::dvec3 middle{ 0.0 };
  double searched = 0.0; ///< all places within this distance of it are here; infinite: all
  glm::dvec3 origin{ 0.0 };
  double extent = 0.0; ///< how far from the origin places, and points searched for, are at most
  std::vector<std::uint32_t> places; ///< indices into a PositionSet
  std::vector<float> x, y, z; ///< relative to the origin; infinite behind the last, up to fours
  void resize(std::size_t count);
};

/// Chooses places of a ball by their squared distance from a point, in float. Loops over them have
/// no branch that depends on a distance: half of those would be mispredicted.
/// Threads  one a thread; memory is kept from point to point.
class PlaceSelection
{
public:
  /// More than any squared distance in float.
  static constexpr float everything = 3e38f;
  /// The time of keepNearest() grows with the square of what is selected.
  static constexpr std::size_t mostToKeepFrom = 96;
  /// Squared distances; behind them eight that are infinite.
  struct Distances
  {
    std::vector<float> squared;
    std::size_t count = 0;
    void close(std::size_t number);
  };

  /// Takes the distances from a point to all of the ball, over two axes or three.
  void measure(const PlaceBall& ball, const glm::dvec3& from, unsigned axes);
  /// Selects those measured that are within the limit.
  void select(float limit);
  /// Where the kept places end: squared distances of the last of them and of the next one
  /// (`everything` if none is selected).
  struct Gap
  {
    float last = 0.0f;
    float next = 0.0f;
  };
  /// Keeps the nearest of the selected. Nothing, and a selection of no use, where several at the
  /// distance of the last cannot be told apart, and for fewer than are wanted or more than
  /// mostToKeepFrom.
  std::optional<Gap> keepNearest(std::size_t wanted);
  /// Puts the selected in order, nearest first but for a share of orderError.
  void sort();

  const Distances& measured() const { return measured_; }
  /// Distances of those selected, in the order of the ball.
  const Distances& distances() const { return distances_; }
  std::size_t size() const { return distances_.count; }
  /// Where in the ball a selected one is.
  std::uint32_t operator[](std::size_t i) const { return selected_[i]; }
  /// The nth of that order.
  std::uint32_t nth(std::size_t n) const { return order_[n]; }
  float limit() const { return limit_; } ///< limit of select()

  /// Possible error of a squared distance in the order of sort().
  static constexpr float orderError = 3e-5f;
  /// A limit within which there are `fewest` to `most` of the distances; where ties or too few of
  /// them leave none, one with more, or `everything`. `likely`: about where it is.
  static float limitOf(
    const Distances& distances, std::size_t fewest, std::size_t most, float likely);
  static std::size_t countWithin(const Distances& distances, float limit);

private:
  Distances measured_;
  Distances distances_;
  std::vector<std::uint32_t> selected_;
  std::vector<std::uint32_t> order_;
  float limit_ = 0.0f;
};

} // namespace pointfront
