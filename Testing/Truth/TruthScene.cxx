#include "TruthScene.h"

namespace pointfront::truth
{

const TruthView* TruthScene::view(const std::string& wanted) const
{
  for (const TruthView& candidate : views)
  {
    if (candidate.name == wanted)
    {
      return &candidate;
    }
  }
  return nullptr;
}

std::optional<TruthScene> makeScene(const std::string& name)
{
  if (name == "town")
  {
    return makeTown();
  }
  return name == "knot" ? std::optional<TruthScene>(makeKnot()) : std::nullopt;
}

} // namespace pointfront::truth
