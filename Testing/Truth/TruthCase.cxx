#include "TruthCase.h"

#include <glm/geometric.hpp>

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

TruthCamera TruthCase::pannedCamera(double px) const
{
  const glm::dvec3 towards = camera_.focalPoint - camera_.position;
  const glm::dvec3 right = glm::normalize(glm::cross(towards, camera_.viewUp));
  const glm::dvec3 move = right * (px * glm::length(towards) / pixels_.focalPx());
  TruthCamera moved = camera_;
  moved.position += move;
  moved.focalPoint += move;
  return moved;
}

} // namespace pointfront::truth
