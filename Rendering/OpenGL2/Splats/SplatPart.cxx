#include "SplatPart.h"

#include "GpuPool.h"
#include "HoleFiller.h"
#include "OpenGLFunctions.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "SoftwareRasteriser.h"
#include "SplatLayer.h"
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
#include <utility>

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
  const bool nothing = plan.batches.empty() && plan.standIns.empty();
  // A picture that was never drawn, or of another size, has no textures that can be composed.
  const bool drawn = target_ == target && target_->has(parts_) &&
    parts_.width == plan.camera.width && parts_.height == plan.camera.height;
  if (nothing && plan.keepsVisible && drawn)
  {
    seen_ = shown_ = {}; // other clouds have the whole budget for a frame: the next one goes on
    return 0;
  }
  target_ = target;
  const PixelRectangle within =
    limits ? *limits : PixelRectangle{ 0, 0, plan.camera.width, plan.camera.height };
  Demand demand;
  const std::int64_t points = list(frame, plan, within, demand);
  seen_ = placeOf(plan, demand.fills, demand.standIns);
  shown_ = limits ? within : seen_;
  selects_ = frame.ids;
  if (!limits && ((points == 0 && !demand.standIns) || shown_.empty()))
  {
    seen_ = shown_ = {};
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
  if (!isSame(plan, demand) && !drawInto(frame, plan, demand))
  {
    forget();
    return noTarget;
  }
  groups_.keep(plan);
  return points;
}

/// The points of the frame, and those that stay of the last one.
std::int64_t SplatPart::list(
  const SplatFrame& frame, const FramePlan& plan, const PixelRectangle& within, Demand& demand)
{
  const float largestPoint = largestPointPx();
  const bool samePlace = renderer_ == frame.renderer && sameRectangle(limits_, within);
  const bool mine = target_->owner() == this && samePlace && parts_.lit == plan.shading.anyLit();
  demand.standIns = !plan.standIns.empty() && !frame.ids;
  demand.fills = plan.shading.fillHoles && !frame.ids; // filled pixels are no points
  demand.mayChange = plan.refining || frame.unfinished;
  const bool growsApart = plan.refining && !frame.ids;
  const std::int64_t points =
    groups_.list(plan, *frame.pool, largestPoint, mine, tools_.records, growsApart);
  if (!frame.ids)
  {
    standIns_.list(frame, plan, largestPoint, samePlace, plan.shading.anyLit());
  }
  // Who was seen is always known: the next frame may be of a view that moves.
  const SplatTarget::Parts parts{ plan.camera.width, plan.camera.height, plan.shading.anyLit(),
    true, groups_.blended(), plan.shading.lookCount() > 1 };
  const bool keeps = plan.keepsVisible && mine && target_->has(parts_);
  demand.goesOn = groups_.goesOn() && target_->has(parts) && (keeps || kept_.empty());
  if (!keeps)
  {
    kept_.clear(); // the kept points are in the last picture
  }
  else if (!demand.goesOn)
  {
    keepVisible(frame, plan, largestPoint);
  }
  parts_ = parts;
  limits_ = within;
  return points;
}

/// Whether the last picture is this one, too.
bool SplatPart::isSame(const FramePlan& plan, const Demand& demand) const
{
  const bool sums = !parts_.blended || (summed_ && (exact_ || demand.mayChange));
  const bool layers = hasStandIns_ == demand.standIns &&
    !(demand.standIns && standIns_.changed()) && !hasGrowing_ && !groups_.grows();
  return demand.goesOn && groups_.addsNothing() && sums && layers && shading_ == plan.shading &&
    fills_ == demand.fills && composited_ == plan.composited;
}

/// Where anything can be seen.
PixelRectangle SplatPart::placeOf(const FramePlan& plan, bool fills, bool standIns) const
{
  if (!kept_.empty())
  {
    return limits_;
  }
  const PixelRectangle shown =
    standIns ? around(groups_.shown(), standIns_.shown()) : groups_.shown();
  return fills ? filledFrom(shown, plan.camera) : shown;
}

void SplatPart::forget()
{
  groups_.forget();
  standIns_.forget();
  summed_ = false;
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

bool SplatPart::drawInto(const SplatFrame& frame, const FramePlan& plan, const Demand& demand)
{
  tools_.records.upload(frame.window);
  shading_ = plan.shading;
  fills_ = demand.fills;
  composited_ = plan.composited;
  hasStandIns_ = demand.standIns;
  hasGrowing_ = groups_.grows();
  vtkOpenGLState* const state = frame.window->GetState();
  const TargetState scope(state);
  state->vtkglViewport(0, 0, parts_.width, parts_.height);
  tools_.vertices->Bind();
  const bool unchanged = exact_ && groups_.addsNothing();
  const bool sumsGoOn = demand.goesOn && summed_ && (demand.mayChange || unchanged);
  summed_ = false;
  if (parts_.blended && sumsGoOn && !groups_.addsNothing())
  {
    target_->keepDepths(frame.window);
  }
  target_->beginSeen(!demand.goesOn);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(limits_.left, limits_.bottom, limits_.width(), limits_.height());
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LESS);
  const auto runs = demand.goesOn ? &SplatGroups::Group::added : &SplatGroups::Group::all;
  const bool resting = plan.refining || !plan.keepsVisible;
  const bool byIds = demand.goesOn || (resting && kept_.empty());
  drawGroups(frame, { runs, parts_, nullptr, byIds, demand.goesOn });
  if (!demand.goesOn)
  {
    kept_.draw(frame, tools_, groups_, parts_, false, target_->seenDepths());
  }
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglScissor(shown_.left, shown_.bottom, shown_.width(), shown_.height());
  if (parts_.blended)
  {
    addSums(frame, sumsGoOn);
  }
  SeenTextures seen = target_->seen();
  vtkTextureObject* const sums = groups_.grows() ? addGrowing(frame, seen) : target_->sums();
  if (demand.standIns)
  {
    seen = standIns_.over(frame, tools_, parts_, limits_, seen);
  }
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglScissor(shown_.left, shown_.bottom, shown_.width(), shown_.height());
  const bool filled =
    !demand.fills || tools_.holes.fill(frame.window, seen, sums, parts_, plan, shown_);
  if (filled)
  {
    state->vtkglScissor(shown_.left, shown_.bottom, shown_.width(), shown_.height());
    target_->beginPicture();
    resolve(frame.window, plan, seen, sums, demand.fills);
  }
  tools_.vertices->Release();
  return filled;
}

/// The second pass. Where something is much nearer than before, what lies behind it is forgotten
/// while more is to come.
void SplatPart::addSums(const SplatFrame& frame, bool goesOn)
{
  vtkOpenGLState* const state = frame.window->GetState();
  const bool adds = !groups_.addsNothing();
  target_->beginSums(!goesOn);
  if (goesOn && adds)
  {
    forgetHidden(frame);
  }
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  const auto runs = goesOn ? &SplatGroups::Group::added : &SplatGroups::Group::all;
  drawGroups(frame, { runs, parts_, target_->seenDepths() });
  if (!goesOn)
  {
    kept_.draw(frame, tools_, groups_, parts_, true, target_->seenDepths());
  }
  state->vtkglDisable(GL_BLEND);
  exact_ = goesOn ? exact_ && !adds : true;
  summed_ = true;
}

void SplatPart::forgetHidden(const SplatFrame& frame)
{
  const RasterCamera& camera = groups_.groups().front().first->camera;
  vtkShaderProgram* const program = tools_.programs.useForget(frame.window, camera.parallel);
  if (!program)
  {
    return; // VTK has told why
  }
  setTexture(program, "seenDepths", target_->seenDepths());
  setTexture(program, "lastDepths", target_->lastDepths());
  program->SetUniformf("forgottenDepth", forgottenPixels / camera.scaleY);
  const float edges[4] = { -1.0f, -1.0f, 1.0f, 1.0f };
  program->SetUniform4f("pictureEdges", edges);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  target_->seenDepths()->Deactivate();
  target_->lastDepths()->Deactivate();
}

/// Where GL has no room for it, points are not seen before they have grown.
vtkTextureObject* SplatPart::addGrowing(const SplatFrame& frame, SeenTextures& seen)
{
  SplatTarget& growing = tools_.growing;
  SplatTarget::Parts own = parts_;
  own.ids = own.picture = false;
  vtkOpenGLState* const state = frame.window->GetState();
  if (!growing.prepare(frame.window, own))
  {
    return target_->sums();
  }
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_TRUE);
  growing.beginSeen(true);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(limits_.left, limits_.bottom, limits_.width(), limits_.height());
  state->vtkglEnable(GL_DEPTH_TEST);
  drawGroups(frame, { &SplatGroups::Group::growing, own, nullptr });
  const bool parallel = groups_.groups().front().first->camera.parallel;
  if (!putLayer(frame, tools_, parts_, limits_, { growing.seen(), nullptr, parallel }, seen) ||
    !parts_.blended)
  {
    return target_->sums();
  }
  growing.takeSums(*target_);
  growing.beginSums(false);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  drawGroups(frame, { &SplatGroups::Group::growing, own, seen.depths });
  state->vtkglDisable(GL_BLEND);
  return growing.sums();
}

void SplatPart::drawGroups(const SplatFrame& frame, Pass pass)
{
  for (const SplatGroups::Group& group : groups_.groups())
  {
    const DrawRuns& runs = group.*pass.runs;
    if (!runs.stretches().empty() && (!pass.seenDepths || group.first->passes.blended))
    {
      drawGroup(frame, group, pass);
      pass.follows = pass.byIds;
    }
  }
}

void SplatPart::drawGroup(
  const SplatFrame& frame, const SplatGroups::Group& group, const Pass& pass)
{
  const bool second = pass.seenDepths != nullptr;
  SplatVariant variant = variantOf(group, pass.parts, second);
  variant.follows = pass.follows;
  vtkShaderProgram* const program = tools_.programs.use(frame.window, variant);
  if (!program)
  {
    return;
  }
  pass.follows ? target_->follow(frame.window, limits_) : void();
  const std::pair<const char*, vtkTextureObject*> textures[] = { { "seenDepths", pass.seenDepths },
    { "earlierDepths", pass.follows ? target_->earlierDepths() : nullptr },
    { "earlierIds", pass.follows ? target_->earlierIds() : nullptr } };
  for (const auto& [name, texture] : textures)
  {
    texture ? setTexture(program, name, texture) : void();
  }
  drawSplatRuns(frame, tools_.records, program, variant, group, group.*pass.runs);
  for (const auto& [name, texture] : textures)
  {
    texture ? texture->Deactivate() : void();
  }
}

void SplatPart::resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan,
  const SeenTextures& seen, vtkTextureObject* sums, bool fills)
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
  vtkTextureObject* const textures[] = { fills ? tools_.holes.seenColours() : seen.colours,
    fills ? tools_.holes.seenDepths() : seen.depths, sums, seen.normals };
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
  standIns_.release(window);
}

} // namespace pointfront
