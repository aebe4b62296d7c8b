#pragma once

#include "pointfront/Style/ResolvedStyle.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace pointfront
{

/// A technique's one name in C++, JSON, the tool and ParaView.
struct TechniqueTraits
{
  Technique technique;
  const char* name;
  bool facing; ///< discs that turn with the point's normal where there is one
};

constexpr std::array<TechniqueTraits, 6> techniqueTraits{ {
  { Technique::Points, "points", false },
  { Technique::Splats, "splats", true },
  { Technique::Spheres, "spheres", false },
  { Technique::Silhouettes, "silhouettes", true },
  { Technique::Solid, "solid", true },
  { Technique::Ewa, "ewa", true },
} };

constexpr const TechniqueTraits& traitsOf(Technique technique)
{
  return techniqueTraits[static_cast<std::size_t>(technique)];
}

/// The technique of that name, exactly as it is written above.
std::optional<Technique> techniqueOf(std::string_view name);
/// "points, splats, spheres ...".
std::string techniqueList();

} // namespace pointfront
