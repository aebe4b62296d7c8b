#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace pointfront
{

/// The surfaces that an airborne laser pulse meets at a place of a made-up landscape: hills, lakes
/// and a river plain, towns with flat and gabled roofs, woods and single trees. A function of
/// (seed, x, y) only: any part can be made by any thread, at any size.
/// Units    metres.
/// Threads  const functions are safe from any thread.
class TerrainModel
{
public:
  explicit TerrainModel(std::uint64_t seed)
    : seed_(seed)
  {
  }

  /// ASPRS classes that occur.
  enum Class : std::uint8_t
  {
    Ground = 2,
    LowVegetation = 3,
    HighVegetation = 5,
    Building = 6,
    Water = 9
  };

  /// One echo of a pulse.
  struct Echo
  {
    double height = 0.0;
    Class objectClass = Ground;
    std::uint8_t returnNumber = 1;
    std::uint8_t returnCount = 1;
  };

  /// The echo that a pulse at (x, y) gives; `chance` in [0, 1) decides among several (through a
  /// tree's crown to the ground, on a wall).
  Echo echoAt(double x, double y, double chance) const;

  /// Colour of what was met, 8 bit a channel; `grain` in [0, 1) varies it from point to point.
  glm::u8vec3 colourOf(const Echo& echo, double x, double y, double grain) const;

  /// Height of the bare earth, without water.
  double groundHeight(double x, double y) const;

private:
  struct Roof
  {
    bool hit = false;
    double height = 0.0; ///< above the ground
    bool wall = false; ///< the pulse grazes the façade
  };
  Roof roofAt(double x, double y) const;
  /// Height of a tree's crown above the ground at (x, y), 0 where there is none.
  double crownAt(double x, double y) const;

  std::uint64_t seed_;
};

} // namespace pointfront
