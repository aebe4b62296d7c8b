#include "Distance.h"

#include <nlohmann/json.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdio>

namespace pointfront
{

double Distance::length() const
{
  return glm::length(to - from);
}

double Distance::horizontal() const
{
  return std::hypot(to.x - from.x, to.y - from.y);
}

std::string textOf(const Distance& distance)
{
  char text[160];
  std::snprintf(text, sizeof text, "distance   %12.3f\nhorizontal %12.3f\nheight     %+12.3f",
    distance.length(), distance.horizontal(), distance.height());
  return text;
}

nlohmann::ordered_json jsonOf(const Distance& distance)
{
  const auto numbers = [](const glm::dvec3& v) { return nlohmann::ordered_json{ v.x, v.y, v.z }; };
  nlohmann::ordered_json object;
  object["distance"] = distance.length();
  object["horizontal"] = distance.horizontal();
  object["height"] = distance.height();
  object["from"] = numbers(distance.from);
  object["to"] = numbers(distance.to);
  return object;
}

} // namespace pointfront
