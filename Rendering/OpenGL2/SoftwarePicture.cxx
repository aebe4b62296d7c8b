#include "SoftwarePicture.h"

#include "OpenGLFunctions.h"
#include "vtkOpenGLPointFrontPicture.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <unordered_map>

namespace pointfront
{
namespace
{

void load(vtkOpenGLRenderWindow* window, vtkTextureObject* texture, const SoftwareTarget& target,
  int components, int type, const void* data)
{
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->Create2DFromRaw(static_cast<unsigned int>(target.width),
    static_cast<unsigned int>(target.height), components, type, const_cast<void*>(data));
}

/// Makes the depths that decided those of the picture, now that it is shaded.
void handDecided(SoftwareTarget& target)
{
  for (std::size_t pixel = 0; pixel < target.decided.size(); ++pixel)
  {
    const bool filled = target.decided[pixel] == std::numeric_limits<float>::infinity();
    target.depth[pixel] = filled ? target.depth[pixel] : target.decided[pixel];
  }
}

} // namespace

SoftwarePicture::SoftwarePicture() = default;
SoftwarePicture::~SoftwarePicture() = default;

/// Drops those of actors that are gone: another one may have the same address.
SoftwarePicture::Picture& SoftwarePicture::pictureOf(vtkRenderer* renderer, vtkActor* actor)
{
  for (auto picture = pictures_.begin(); picture != pictures_.end();)
  {
    picture = picture->second.actor ? std::next(picture) : pictures_.erase(picture);
  }
  Picture& picture = pictures_[{ renderer, actor }];
  picture.actor = actor;
  return picture;
}

RasterStatistics SoftwarePicture::draw(
  vtkOpenGLRenderWindow* window, vtkRenderer* renderer, vtkActor* actor, FramePlan& plan, bool ids)
{
  int viewport[4];
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  originPx_[0] = viewport[0];
  originPx_[1] = viewport[1];
  plan.camera.setViewport(std::max(1, viewport[2]), std::max(1, viewport[3]), plan.camera.margin);
  Picture& picture = pictureOf(renderer, actor);
  picture.target.keepPoints = ids;
  picture.target.keepDecided = plan.composited;
  const RasterStatistics statistics =
    picture.composition.drawShown(picture.rasteriser, plan, picture.target);
  picture.composition.finish(plan.camera, plan.shading, picture.target, plan.exchange);
  if (plan.composited)
  {
    handDecided(picture.target);
  }
  last_ = &picture.target;
  ids_.clear();
  if (ids)
  {
    numberPoints(plan);
  }
  return statistics;
}

/// Numbers in the store: the same ids as points have that GL draws.
void SoftwarePicture::numberPoints(const FramePlan& plan)
{
  std::unordered_map<NodeIndex, std::uint64_t> firstPoints;
  for (const std::vector<DrawBatch>* const batches : { &plan.batches, &plan.standIns })
  {
    for (const DrawBatch& batch : *batches)
    {
      for (const PlanItem& item : batch.items)
      {
        firstPoints[item.node->node] = item.node->firstPoint;
      }
    }
  }
  ids_.reserve(2 * last_->points.size());
  for (const PixelPoint& point : last_->points)
  {
    const auto first = firstPoints.find(point.node);
    const bool known = point.store != PixelPoint::nothing && first != firstPoints.end();
    const std::uint64_t id = known ? first->second + point.index : 0;
    ids_.push_back(static_cast<float>(id & 0xffffffu));
    ids_.push_back(static_cast<float>(id >> 24 & 0xffffffu));
  }
}

void SoftwarePicture::handOver(vtkOpenGLRenderWindow* window, vtkRenderer* renderer,
  vtkActor* actor, const FramePlan& plan, std::int64_t storePoints, vtkMapper* owner)
{
  if (last_->rectangle().empty())
  {
    return; // beside the view
  }
  load(window, colour_, *last_, 4, VTK_UNSIGNED_CHAR, last_->rgba.data());
  load(window, depth_, *last_, 1, VTK_FLOAT, last_->depth.data());
  if (!ids_.empty())
  {
    load(window, idTexture_, *last_, 2, VTK_FLOAT, ids_.data());
  }
  if (!mapper_)
  {
    mapper_ = vtkSmartPointer<vtkOpenGLPointFrontPicture>::New();
  }
  PictureDrawing drawing;
  drawing.colour = colour_;
  drawing.depth = depth_;
  drawing.ids = ids_.empty() ? nullptr : idTexture_.GetPointer();
  drawing.camera = &plan.camera;
  drawing.textures = last_->rectangle();
  drawing.place = drawing.textures;
  std::copy(originPx_, originPx_ + 2, drawing.originPx);
  drawing.storePoints = storePoints;
  drawing.owner = owner;
  mapper_->Draw(renderer, actor, drawing);
}

void SoftwarePicture::leaveScreen()
{
  pictures_.clear();
  last_ = nullptr;
}

void SoftwarePicture::release(vtkOpenGLRenderWindow* window)
{
  for (vtkTextureObject* texture :
    { colour_.GetPointer(), depth_.GetPointer(), idTexture_.GetPointer() })
  {
    texture->ReleaseGraphicsResources(window);
  }
  if (mapper_)
  {
    mapper_->ReleaseGraphicsResources(window);
  }
  mapper_ = nullptr;
  leaveScreen();
}

} // namespace pointfront
