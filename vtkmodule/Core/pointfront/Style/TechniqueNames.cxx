#include "pointfront/Style/TechniqueNames.h"

namespace pointfront
{

std::optional<Technique> techniqueOf(std::string_view name)
{
  for (const TechniqueTraits& traits : techniqueTraits)
  {
    if (traits.name == name)
    {
      return traits.technique;
    }
  }
  return std::nullopt;
}

std::string techniqueList()
{
  std::string list;
  for (const TechniqueTraits& traits : techniqueTraits)
  {
    list += (list.empty() ? "" : ", ") + std::string(traits.name);
  }
  return list;
}

} // namespace pointfront
