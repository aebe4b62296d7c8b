#pragma once

#include "pointfront/Base/Bounds.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// How a region meets a box.
enum class Overlap : std::uint8_t
{
  Outside, ///< contains() is false for every point of the box
  Crossing, ///< nothing is known
  Inside ///< contains() is true for every point of the box
};

/// A closed set of places in space: its surface belongs to it.
/// Units       world units of the store.
/// Exactness   overlap() never contradicts contains(), so a query that leaves nodes out, or takes
///             them whole, gives the same points as one that asks contains() of each.
/// Threads     immutable; const functions from any thread.
class Region
{
public:
  virtual ~Region() = default;
  virtual bool contains(const glm::dvec3& point) const = 0;
  virtual Overlap overlap(const Bounds& box) const = 0;
  /// A box that contains the region; may reach to infinity.
  virtual Bounds bounds() const = 0;
  /// keep[i] = 0 where contains(points[i]) is false; the others stay as they are. All points lie in
  /// `box`, which lets a region of many edges look at those nearby only.
  virtual void keepInside(
    const Bounds& box, const glm::dvec3* points, std::size_t count, std::uint8_t* keep) const;

protected:
  Region() = default;
  Region(const Region&) = default;
  Region& operator=(const Region&) = default;
};

} // namespace pointfront
