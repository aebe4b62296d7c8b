#pragma once

#include "pointfront/Style/ResolvedStyle.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace pointfront
{

/// What draws a plan.
enum class Backend : std::uint8_t
{
  OpenGL,
  Software
};

/// A technique's one name in C++, JSON, the tool and ParaView, and who draws it in this version:
/// the only place that says so.
struct TechniqueTraits
{
  Technique technique;
  const char* name;
  bool openGL;
  bool software;
  bool facing;  ///< discs that turn with the point's normal where there is one
};

constexpr std::array<TechniqueTraits, 6> techniqueTraits{ {
  { Technique::Points, "points", true, true, false },
  { Technique::Splats, "splats", true, true, true },
  { Technique::Spheres, "spheres", true, true, false },
  { Technique::Silhouettes, "silhouettes", false, false, true },
  { Technique::Solid, "solid", false, false, false },
  { Technique::Ewa, "ewa", true, true, true },
} };

constexpr const TechniqueTraits& traitsOf(Technique technique)
{
  return techniqueTraits[static_cast<std::size_t>(technique)];
}

constexpr bool techniqueIsAvailable(Technique technique, Backend backend)
{
  return backend == Backend::OpenGL ? traitsOf(technique).openGL : traitsOf(technique).software;
}
/// At least one back end draws it.
constexpr bool techniqueIsAvailable(Technique technique)
{
  return traitsOf(technique).openGL || traitsOf(technique).software;
}

/// The technique of that name, exactly as it is written above.
std::optional<Technique> techniqueOf(std::string_view name);
/// "points, splats, spheres ...": those that are available, or all.
std::string techniqueList(bool availableOnly);

} // namespace pointfront
