#include "SplatPart.h"

#include "GpuPool.h"
#include "HoleFiller.h"
#include "OpenGLFunctions.h"
#include "RasterItems.h"
#include "SoftwareRasteriser.h"
#include "SplatLights.h"
#include "SplatRuns.h"
#include "SplatUniforms.h"
#include "TargetState.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

bool sameRectangle(const PixelRectangle& a, const PixelRectangle& b)
{
  return a.contains(b) && b.contains(a);
}

float largestPointPx()
{
  float sizes[2] = { 1.0f, 1.0f };
  glGetFloatv(GL_POINT_SIZE_RANGE, sizes);
  return sizes[1];
}

} // namespace

SplatPart::SplatPart(SplatTools& tools)
  : tools_(tools)
{
}

SplatPart::~SplatPart() = default;

std::int64_t SplatPart::draw(const SplatFrame& frame, const FramePlan& plan,
  const std::shared_ptr<SplatTarget>& target, const PixelRectangle* limits)
{
  if (plan.batches.empty() && plan.keepsVisible && target_ == target)
  {
    seen_ = shown_ = {}; // other clouds have the whole budget for a frame: the next one goes on
    return 0;
  }
  target_ = target;
  const float largestPoint = largestPointPx();
  const PixelRectangle within =
    limits ? *limits : PixelRectangle{ 0, 0, plan.camera.width, plan.camera.height };
  const bool mine = target_->owner() == this && renderer_ == frame.renderer &&
    parts_.lit == plan.shading.anyLit() && sameRectangle(limits_, within);
  const std::int64_t points = groups_.list(plan, *frame.pool, largestPoint, mine, tools_.records);
  // Who was seen is always known: the next frame may be of a view that moves.
  const SplatTarget::Parts parts{ plan.camera.width, plan.camera.height, plan.shading.anyLit(),
    true, groups_.blended(), plan.shading.lookCount() > 1 };
  const bool keeps = plan.keepsVisible && mine && target_->has(parts_);
  const bool goesOn = groups_.goesOn() && target_->has(parts) && (keeps || kept_.empty());
  if (!keeps)
  {
    kept_.clear(); // the kept points are in the last picture
  }
  else if (!goesOn)
  {
    keepVisible(frame, plan, largestPoint);
  }
  parts_ = parts;
  limits_ = within;
  const bool fills = plan.shading.fillHoles && !frame.ids; // filled pixels are no points
  seen_ = placeOf(plan, fills);
  shown_ = limits ? within : seen_;
  selects_ = frame.ids;
  if (!limits && (points == 0 || shown_.empty()))
  {
    forget();
    return points;
  }
  if (!target_->prepare(frame.window, parts_))
  {
    forget();
    return noTarget;
  }
  target_->setOwner(this);
  renderer_ = frame.renderer;
  const bool same = goesOn && groups_.addsNothing() && shading_ == plan.shading &&
    fills_ == fills && composited_ == plan.composited;
  if (!same && !drawInto(frame, plan, goesOn, fills))
  {
    forget();
    return noTarget;
  }
  groups_.keep(plan);
  return points;
}

/// Where anything can be seen.
PixelRectangle SplatPart::placeOf(const FramePlan& plan, bool fills) const
{
  if (!kept_.empty())
  {
    return limits_;
  }
  return fills ? filledFrom(groups_.shown(), plan.camera) : groups_.shown();
}

void SplatPart::forget()
{
  groups_.forget();
  kept_.clear();
}

/// Before anything is drawn into the target: it says who was seen.
void SplatPart::keepVisible(const SplatFrame& frame, const FramePlan& plan, float largestPointPx)
{
  FramePlan lost = groups_.leaving(plan);
  kept_.leaveOutKnown(lost);
  SplatGroups leaving;
  leaving.list(lost, *frame.pool, largestPointPx, false, tools_.lastRecords);
  if (leaving.groups().empty() && kept_.empty())
  {
    return;
  }
  leaving.groups().empty() ? void() : tools_.lastRecords.upload(frame.window);
  kept_.collect(frame, tools_, leaving, plan, { groups_.lastCamera(), target_->ids() });
}

bool SplatPart::drawInto(const SplatFrame& frame, const FramePlan& plan, bool goesOn, bool fills)
{
  tools_.records.upload(frame.window);
  shading_ = plan.shading;
  fills_ = fills;
  composited_ = plan.composited;
  vtkOpenGLState* const state = frame.window->GetState();
  const TargetState scope(state);
  state->vtkglViewport(0, 0, parts_.width, parts_.height);
  tools_.vertices->Bind();
  target_->beginSeen(!goesOn);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(limits_.left, limits_.bottom, limits_.width(), limits_.height());
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LESS);
  drawGroups(frame, false, goesOn);
  if (!goesOn)
  {
    kept_.draw(frame, tools_, groups_, parts_, false, target_->seenDepths());
  }
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglScissor(shown_.left, shown_.bottom, shown_.width(), shown_.height());
  if (parts_.blended)
  {
    target_->beginSums();
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
    drawGroups(frame, true, false);
    kept_.draw(frame, tools_, groups_, parts_, true, target_->seenDepths());
    state->vtkglDisable(GL_BLEND);
  }
  const bool filled = !fills || tools_.holes.fill(frame.window, *target_, parts_, plan, shown_);
  if (filled)
  {
    state->vtkglScissor(shown_.left, shown_.bottom, shown_.width(), shown_.height());
    target_->beginPicture();
    resolve(frame.window, plan, fills);
  }
  tools_.vertices->Release();
  return filled;
}

void SplatPart::drawGroups(const SplatFrame& frame, bool second, bool addedOnly)
{
  for (const SplatGroups::Group& group : groups_.groups())
  {
    const DrawRuns& runs = addedOnly ? group.added : group.all;
    if (!runs.stretches().empty() && (!second || group.first->passes.blended))
    {
      drawGroup(frame, group, runs, second);
    }
  }
}

void SplatPart::drawGroup(
  const SplatFrame& frame, const SplatGroups::Group& group, const DrawRuns& runs, bool second)
{
  const SplatVariant variant = variantOf(group, parts_, second);
  vtkShaderProgram* const program = tools_.programs.use(frame.window, variant);
  if (!program)
  {
    return;
  }
  setTexture(program, "seenDepths", target_->seenDepths());
  drawSplatRuns(frame, tools_.records, program, variant, group, runs);
  if (second)
  {
    target_->seenDepths()->Deactivate();
  }
}

void SplatPart::resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan, bool fills)
{
  const FrameShading& shading = plan.shading;
  const bool lit = parts_.lit && !fills; // filled pixels are lit before
  vtkShaderProgram* const program = tools_.programs.useResolve(
    window, { parts_.blended && !fills, lit, shading.anyEyeDome(), looksOf(shading) });
  if (!program)
  {
    return;
  }
  const glm::dmat4& clip = plan.camera.viewToClip;
  const double nearDepth = (clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]);
  const bool parallel = plan.camera.parallel;
  program->SetUniformf("depthShift", depthShiftOf(plan.camera));
  program->SetUniformi("composited", plan.composited ? 1 : 0);
  program->SetUniformf("octaveShift",
    parallel ? static_cast<float>(plan.camera.wholeWorldHeight() - nearDepth) : 0.0f);
  setLooks(program, shading);
  const int size[2] = { parts_.width, parts_.height };
  program->SetUniform2i("pictureSize", size);
  lit ? setLights(program, plan) : void();
  vtkTextureObject* const textures[] = {
    fills ? tools_.holes.seenColours() : target_->seenColours(),
    fills ? tools_.holes.seenDepths() : target_->seenDepths(), target_->sums(), target_->normals()
  };
  const char* const names[] = { "seenColours", "seenDepths", "colourSums", "seenNormals" };
  for (int i = 0; i < 4; ++i)
  {
    setTexture(program, names[i], textures[i]);
  }
  const float edges[4] = { -1.0f, -1.0f, 1.0f, 1.0f };
  program->SetUniform4f("pictureEdges", edges);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  for (vtkTextureObject* texture : textures)
  {
    if (texture->GetTextureUnit() >= 0)
    {
      texture->Deactivate();
    }
  }
}

SplatTextures SplatPart::picture() const
{
  return { target_->pictureColour(), target_->pictureDepth(), selects_ ? target_->ids() : nullptr };
}

void SplatPart::release(vtkOpenGLRenderWindow* window)
{
  if (target_)
  {
    target_->release(window);
    target_ = nullptr;
  }
  forget();
}

} // namespace pointfront
