#pragma once

#include <nlohmann/json_fwd.hpp>

#include <glm/vec3.hpp>

#include <string>

namespace pointfront
{

/// From one point to another, in units of their coordinates.
struct Distance
{
  glm::dvec3 from{ 0.0 };
  glm::dvec3 to{ 0.0 };

  double length() const;
  double horizontal() const;
  double height() const { return to.z - from.z; } ///< up is positive
};

/// For people, three lines.
std::string textOf(const Distance& distance);
/// `distance`, `horizontal`, `height`, `from`, `to`.
nlohmann::ordered_json jsonOf(const Distance& distance);

} // namespace pointfront
