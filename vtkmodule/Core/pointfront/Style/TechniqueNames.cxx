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

std::string techniqueList(bool availableOnly)
{
  std::string list;
  for (const TechniqueTraits& traits : techniqueTraits)
  {
    if (!availableOnly || techniqueIsAvailable(traits.technique))
    {
      list += (list.empty() ? "" : ", ") + std::string(traits.name);
    }
  }
  return list;
}

} // namespace pointfront
