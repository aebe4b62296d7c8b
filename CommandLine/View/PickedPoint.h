#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"

#include <nlohmann/json.hpp>

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>

namespace pointfront
{

/// A stored point with all that the store holds of it.
struct PickedPoint
{
  std::string store; ///< path
  std::uint64_t id = 0; ///< number in the store
  glm::dvec3 position{ 0.0 }; ///< world
  /// Name -> value, or list of values, with scale and offset applied; in the store's order.
  nlohmann::ordered_json attributes = nlohmann::ordered_json::object();
};

/// Reads one node.
/// Errors  those of pointsById().
Result<PickedPoint> readPoint(const StoredCloud& store, std::uint64_t id);

/// For people: a line for the position and for each attribute.
std::string textOf(const PickedPoint& point);
/// For programs: an object with `store`, `id`, `x`, `y`, `z` and the attributes. An attribute of
/// one of these names has an underscore at its end.
nlohmann::ordered_json jsonOf(const PickedPoint& point);

} // namespace pointfront
