#include "ViewCamera.h"

#include "CameraMotion.h"
#include "Frustum.h"
#include "MappedStores.h"
#include "PointPick.h"

#include <vtkRenderer.h>
#include <vtkRenderWindow.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <memory>

namespace pointfront
{

namespace
{
constexpr float background = 1.0f; // depth
constexpr double leastScale = 1.0e-6; // smallest scale of a parallel view
} // namespace

ViewCamera::ViewCamera(vtkRenderer* renderer, const MappedStores& stores)
  : renderer_(renderer)
  , stores_(stores)
{
}

void ViewCamera::set(const Camera& camera)
{
  camera_ = camera;
  all_.reset();
  stores_.aim(camera_, renderer_->GetActiveCamera());
}

void ViewCamera::showAll(ViewDirection direction)
{
  const glm::ivec2 pixels = size();
  set(cameraFitting(stores_.bounds(), direction, static_cast<double>(pixels.x) / pixels.y));
  all_ = direction;
}

void ViewCamera::follow()
{
  all_ ? showAll(*all_) : set(camera_);
}

bool ViewCamera::obey(KeyAction action, ViewDirection home)
{
  switch (action)
  {
    case KeyAction::ShowAll:
      showAll(home);
      return true;
    case KeyAction::ViewIso:
      showAll(ViewDirection::Iso);
      return true;
    case KeyAction::ViewTop:
      showAll(ViewDirection::Top);
      return true;
    case KeyAction::ViewFront:
      showAll(ViewDirection::Front);
      return true;
    case KeyAction::ViewBack:
      showAll(ViewDirection::Back);
      return true;
    case KeyAction::ViewLeft:
      showAll(ViewDirection::Left);
      return true;
    case KeyAction::ViewRight:
      showAll(ViewDirection::Right);
      return true;
    case KeyAction::Projection:
      set(otherProjection(camera_));
      return true;
    default:
      return false;
  }
}

glm::ivec2 ViewCamera::size() const
{
  const int* const size = renderer_->GetRenderWindow()->GetSize();
  return glm::max(glm::ivec2(size[0], size[1]), glm::ivec2(1));
}

std::optional<glm::dvec3> ViewCamera::surfaceAt(const glm::ivec2& pixel) const
{
  const glm::ivec2 low = glm::clamp(pixel - reachPx, glm::ivec2(0), size() - 1);
  const glm::ivec2 high = glm::clamp(pixel + reachPx, glm::ivec2(0), size() - 1);
  const std::unique_ptr<float[]> depths(
    renderer_->GetRenderWindow()->GetZbufferData(low.x, low.y, high.x, high.y));
  double nearest = 2.0 * reachPx;
  std::optional<glm::dvec3> found;
  const float* depth = depths.get();
  for (glm::ivec2 at = low; depth != nullptr && at.y <= high.y; ++at.y)
  {
    for (at.x = low.x; at.x <= high.x; ++at.x, ++depth)
    {
      const double distance = glm::length(glm::dvec2(at - pixel));
      if (*depth < background && distance < nearest)
      {
        nearest = distance;
        found = glm::dvec3(glm::dvec2(at) + 0.5, static_cast<double>(*depth));
      }
    }
  }
  if (!found)
  {
    return std::nullopt;
  }
  renderer_->SetDisplayPoint(found->x, found->y, found->z);
  renderer_->DisplayToWorld();
  std::array<double, 4> world{};
  renderer_->GetWorldPoint(world.data());
  return glm::dvec3(world[0], world[1], world[2]) / world[3];
}

glm::dvec3 ViewCamera::anchorAt(const glm::ivec2& pixel) const
{
  const std::optional<glm::dvec3> surface = surfaceAt(pixel);
  return surface ? *surface : underPixel(camera_, camera_.focalPoint, glm::dvec2(pixel), size());
}

void ViewCamera::zoom(const glm::dvec3& anchor, double factor)
{
  const Camera moved = zoomed(camera_, anchor, factor);
  const double depth = glm::dot(anchor - moved.position, moved.direction());
  const bool visible = moved.parallelScale ? *moved.parallelScale > leastScale
                                           : depth > clippingRange(moved, stores_.bounds())[0];
  if (factor > 1.0 || visible)
  {
    set(moved);
  }
}

} // namespace pointfront
