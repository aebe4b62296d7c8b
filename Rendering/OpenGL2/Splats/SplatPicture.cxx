#include "SplatPicture.h"

#include "HoleFiller.h"
#include "OpenGLFunctions.h"
#include "PerWindow.h"
#include "TargetState.h"
#include "vtkOpenGLPointFrontPicture.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>

#include <algorithm>
#include <map>

namespace pointfront
{
namespace
{

bool isSeveral(const FramePlan& plan)
{
  return isComposed(plan) || !plan.shading.lenses.empty() || !plan.shading.highlights.empty();
}

/// Pixels of the viewport that a lens can cover, and those around them that light looks at.
PixelRectangle limitsOf(const PlanPart& part, const FramePlan& plan)
{
  const PixelRectangle viewport{ 0, 0, plan.camera.width, plan.camera.height };
  const auto lens = static_cast<std::size_t>(std::max<std::int16_t>(part.lens, 0));
  if (part.lens < 0 || lens >= plan.shading.lenses.size())
  {
    return viewport;
  }
  const std::array<int, 4> e =
    plan.shading.lenses[lens].extent(plan.camera.width, plan.camera.height);
  const int reach = plan.shading.reachPx();
  const PixelRectangle place{ e[0] - reach, e[1] - reach, e[2] + reach, e[3] + reach };
  return common(viewport, place);
}

} // namespace

SplatPicture::SplatPicture()
  : main_(tools_)
{
}

SplatPicture::~SplatPicture() = default;

std::int64_t SplatPicture::draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer,
  FramePlan& plan, const GpuPool& pool, const TableOf& tableOf, bool ids, bool unfinished)
{
  int viewport[4];
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  originPx_[0] = viewport[0];
  originPx_[1] = viewport[1];
  plan.camera.setViewport(std::max(1, viewport[2]), std::max(1, viewport[3]), plan.camera.margin);
  const SplatFrame frame{ window, renderer, &pool, tableOf, ids, unfinished };
  if (!plan.shading.fillHoles)
  {
    tools_.holes.release(window);
  }
  if (!plan.refining && !ids)
  {
    tools_.releaseTogether(window);
  }
  if (isSeveral(plan))
  {
    return drawParts(frame, plan);
  }
  for (FurtherPart& part : further_)
  {
    part.part->release(window);
  }
  further_.clear();
  composition_.release(window); // a plan of one part does not need it
  const std::int64_t points = main_.draw(frame, plan, mainTarget(frame, plan), nullptr);
  shown_ = points == noTarget ? PixelRectangle() : main_.shown();
  picture_ = shown_.empty() ? SplatTextures() : main_.picture();
  // Each point once, though several styles of a layer may draw it.
  return std::min(points, static_cast<std::int64_t>(plan.pointCount()));
}

std::shared_ptr<SplatTarget> SplatPicture::mainTarget(
  const SplatFrame& frame, const FramePlan& plan)
{
  targets_ = perWindow<SplatTargets>(frame.window);
  return targets_->of(this, std::int64_t(plan.camera.width) * plan.camera.height);
}

std::int64_t SplatPicture::keptPoints() const
{
  std::int64_t points = main_.keptPoints();
  for (const FurtherPart& part : further_)
  {
    points += part.drawn ? part.part->keptPoints() : 0;
  }
  return points;
}

SplatPicture::FurtherPart& SplatPicture::furtherPart(const PlanPart& like)
{
  const auto found = std::find_if(further_.begin(), further_.end(),
    [&](const FurtherPart& part)
    { return part.lens == like.lens && part.mask == like.mask && part.group == like.group; });
  if (found != further_.end())
  {
    return *found;
  }
  further_.push_back({ like.lens, like.mask, like.group, like.opacity, false,
    std::make_shared<SplatTarget>(), std::make_unique<SplatPart>(tools_) });
  return further_.back();
}

const SplatPicture::FurtherPart* SplatPicture::find(std::int16_t lens, bool mask) const
{
  const auto found = std::find_if(further_.begin(), further_.end(),
    [&](const FurtherPart& part)
    { return part.drawn && part.lens == lens && part.mask == mask && part.group == 0; });
  return found == further_.end() ? nullptr : &*found;
}

std::int64_t SplatPicture::drawParts(const SplatFrame& frame, const FramePlan& plan)
{
  for (FurtherPart& part : further_)
  {
    part.drawn = false;
  }
  const PixelRectangle viewport{ 0, 0, plan.camera.width, plan.camera.height };
  std::int64_t points = 0;
  shown_ = {};
  for (PlanPart& part : partsOf(plan))
  {
    const PixelRectangle limits = limitsOf(part, plan);
    if (part.mask)
    {
      part.plan.shading = FrameShading();
      part.plan.keepsVisible = false; // where a class is now
    }
    part.plan.shading.lenses.clear(); // these are for the whole
    part.plan.shading.highlights.clear();
    const bool isMain = part.lens < 0 && part.group == 0;
    FurtherPart* const further = isMain ? nullptr : &furtherPart(part);
    if (!isMain && limits.empty())
    {
      continue;
    }
    SplatPart& drawing = isMain ? main_ : *further->part;
    const std::int64_t drawn =
      drawing.draw(frame, part.plan, isMain ? mainTarget(frame, plan) : further->target, &limits);
    if (drawn == noTarget)
    {
      return noTarget;
    }
    points += drawn;
    shown_ = around(shown_, common(drawing.shown(), limits));
    if (further)
    {
      further->drawn = true;
      further->opacity = part.opacity;
    }
  }
  const int reach = shown_.empty() ? 0 : plan.shading.reachPx();
  shown_ = common(viewport,
    { shown_.left - reach, shown_.bottom - reach, shown_.right + reach, shown_.top + reach });
  if (!composition_.begin(frame.window, viewport.right, viewport.top, frame.ids))
  {
    return noTarget;
  }
  const TargetState scope(frame.window->GetState());
  frame.window->GetState()->vtkglViewport(0, 0, viewport.right, viewport.top);
  frame.window->GetState()->vtkglDisable(GL_DEPTH_TEST);
  frame.window->GetState()->vtkglDepthMask(GL_FALSE);
  tools_.vertices->Bind();
  compose(plan);
  tools_.vertices->Release();
  return std::min(points, static_cast<std::int64_t>(plan.pointCount()));
}

SplatTextures SplatPicture::blended(
  std::int16_t lens, const SplatTextures& base, const SplatTextures& untouched)
{
  std::map<std::uint16_t, SplatComposition::Group> byNumber; // parts lie as they came to be
  for (const FurtherPart& part : further_)
  {
    if (part.drawn && part.lens == lens && part.group > 0)
    {
      byNumber.insert({ part.group, { part.part->picture(), part.opacity } });
    }
  }
  std::vector<SplatComposition::Group> groups;
  for (const auto& [number, group] : byNumber)
  {
    groups.push_back(group);
  }
  return composition_.blend(base, groups, untouched);
}

void SplatPicture::compose(const FramePlan& plan)
{
  picture_ = main_.picture();
  SplatTextures inside; // textures inside the lens that is put next
  for (const CompositionStep& step : compositionOf(plan.shading))
  {
    switch (step.kind)
    {
      case CompositionStep::Kind::BlendGroups:
        if (step.lens < 0)
        {
          picture_ = blended(step.lens, picture_, {});
        }
        else
        {
          const FurtherPart* const opaque = find(step.lens, false);
          inside = opaque ? blended(step.lens, opaque->part->picture(), picture_) : SplatTextures();
        }
        break;
      case CompositionStep::Kind::PutLens:
        putLens(plan.shading.lenses[static_cast<std::size_t>(step.lens)], step.lens, inside);
        break;
      case CompositionStep::Kind::Highlight:
        picture_ = composition_.highlight(picture_, plan.shading.highlights);
        break;
    }
  }
}

void SplatPicture::putLens(const FrameLens& lens, std::int16_t number, const SplatTextures& inside)
{
  const FurtherPart* const mask = find(number, true);
  const bool around = lens.shape == LensShape::AroundClass;
  if (!around || mask)
  {
    picture_ =
      composition_.putLens(picture_, inside, lens, around ? mask->part->picture().depths : nullptr);
  }
}

void SplatPicture::handOver(vtkRenderer* renderer, vtkActor* actor, const FramePlan& plan,
  std::int64_t storePoints, vtkMapper* owner)
{
  if (shown_.empty())
  {
    return; // beside the view
  }
  if (!mapper_)
  {
    mapper_ = vtkSmartPointer<vtkOpenGLPointFrontPicture>::New();
  }
  PictureDrawing drawing;
  drawing.colour = picture_.colours;
  drawing.depth = picture_.depths;
  drawing.ids = picture_.ids;
  drawing.camera = &plan.camera;
  drawing.textures = { 0, 0, plan.camera.width, plan.camera.height };
  drawing.place = shown_;
  std::copy(originPx_, originPx_ + 2, drawing.originPx);
  drawing.storePoints = storePoints;
  drawing.owner = owner;
  mapper_->Draw(renderer, actor, drawing);
}

void SplatPicture::release(vtkOpenGLRenderWindow* window)
{
  main_.release(window);
  for (FurtherPart& part : further_)
  {
    part.part->release(window);
  }
  further_.clear();
  composition_.release(window);
  tools_.records.release(window);
  tools_.lastRecords.release(window);
  tools_.holes.release(window);
  tools_.releaseTogether(window);
  tools_.vertices->ReleaseGraphicsResources();
  if (mapper_)
  {
    mapper_->ReleaseGraphicsResources(window);
  }
  mapper_ = nullptr;
  shown_ = {};
}

} // namespace pointfront
