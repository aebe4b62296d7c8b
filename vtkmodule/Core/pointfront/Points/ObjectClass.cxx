#include "pointfront/Points/ObjectClass.h"

#include <array>

namespace pointfront
{

std::string objectClassName(std::uint8_t objectClass)
{
  static const std::array<const char*, 23> names{ "never classified", "unclassified", "ground",
    "low vegetation", "medium vegetation", "high vegetation", "building", "low point", nullptr,
    "water", "rail", "road surface", nullptr, "wire guard", "wire conductor", "transmission tower",
    "wire connector", "bridge deck", "high noise", "overhead structure", "ignored ground", "snow",
    "temporal exclusion" };
  return objectClass < names.size() && names[objectClass] != nullptr
    ? std::string(names[objectClass])
    : "class " + std::to_string(objectClass);
}

} // namespace pointfront
