#include "TruthCase.h"

#include <cassert>
#include <utility>

namespace pointfront::truth
{
namespace
{
const TruthView& viewOf(const TruthScene& scene, const std::string& name)
{
  const TruthView* view = scene.view(name);
  assert(view != nullptr);
  return *view;
}
} // namespace

TruthCase::TruthCase(TruthScene scene, const Choice& choice)
  : scene_(std::move(scene))
  , camera_(viewOf(scene_, choice.view).camera)
  , rays_(scene_.mesh)
  , pixels_(camera_, choice.width, choice.height)
{
  SpacingGrade& grade = region_.grade;
  grade.medianDepth = medianDepth(rays_, camera_, double(choice.width) / choice.height);
  grade.spacing = choice.spacingPx * grade.medianDepth / pixels_.focalPx();
  grade.graded = viewOf(scene_, choice.view).graded;
}

} // namespace pointfront::truth
