#include "ClassChoice.h"

#include <algorithm>

namespace pointfront
{

Result<ClassSet> chosenClasses(
  const PointSources& sources, const std::optional<std::vector<std::uint8_t>>& wanted)
{
  if (!wanted)
  {
    return ClassSet().set();
  }
  const bool classified = std::any_of(sources.begin(), sources.end(),
    [](const auto& source)
    { return source->description().schema.find("classification").has_value(); });
  if (!classified)
  {
    return makeError(Error::Kind::BadArgument,
      "normals of some classes only: no input has a classification; leave the classes out");
  }
  ClassSet classes;
  for (const std::uint8_t code : *wanted)
  {
    classes.set(code);
  }
  return classes;
}

} // namespace pointfront
