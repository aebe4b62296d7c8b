#include "SplatPicture.h"

#include "ColourTable.h"
#include "DrawBatches.h"
#include "GpuPool.h"
#include "RasterItems.h"
#include "SplatAttributes.h"
#include "SplatUniforms.h"
#include "TargetState.h"
#include "vtkOpenGLPointFrontPicture.h"

#include <vtk_glew.h>

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{

/// As in Shading.cxx.
constexpr float eyeDomeGain = 300.0f;
constexpr std::size_t mostLights = 8;
/// A sphere or an ellipse may be longer on screen than its radius at its centre says.
constexpr float mostStretch = 1.6f;

bool sameCamera(const FrameCamera& a, const FrameCamera& b)
{
  return a.storeToView == b.storeToView && a.viewToClip == b.viewToClip &&
    a.reference == b.reference && a.referenceInView == b.referenceInView &&
    a.parallel == b.parallel && a.width == b.width && a.height == b.height;
}

std::vector<std::shared_ptr<const ResolvedStyle>> stylesOf(const FramePlan& plan)
{
  std::vector<std::shared_ptr<const ResolvedStyle>> styles;
  for (const DrawBatch& batch : plan.batches)
  {
    styles.push_back(batch.style);
  }
  return styles;
}

/// Diameter in pixels that no splat of the node exceeds.
float largestSplat(const RasterItem& item, const RasterItems& items)
{
  if (item.passes.squares)
  {
    return static_cast<float>(item.passes.squareSize);
  }
  const RasterCamera& camera = item.camera;
  const SplatPass& pass = item.passes.blended ? item.passes.second : item.passes.first;
  const glm::vec3 half = item.node().halfSize * items.radiusFactor();
  float nearest = camera.nearDepth;
  if (!camera.parallel)
  {
    const NodeColumns& node = item.node();
    float depth = camera.matrix[2][3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double step = items.plan().grid.scale[axis] *
        std::ldexp(1.0, static_cast<int>(item.positions.shift));
      const double steps =
        static_cast<double>(node.halfSize[axis]) / step - item.positions.steps[axis];
      depth += camera.matrix[2][axis] * static_cast<float>(steps);
    }
    nearest = std::max(nearest, depth - glm::length(half));
  }
  const float reach = camera.parallel ? 1.0f : nearest;
  float radius = 4.0f * item.radius * item.passes.secondRadius; // its own may be as large
  if (item.style->size.mode == SplatSize::Mode::Attribute)
  {
    radius = std::numeric_limits<float>::max();
  }
  float pixels = radius * camera.scaleY / reach;
  if (item.style->size.mode == SplatSize::Mode::Pixels)
  {
    pixels = static_cast<float>(item.style->size.value);
  }
  return 2.0f * mostStretch * std::clamp(pixels, pass.leastRadius, pass.mostRadius);
}

void setTexture(vtkShaderProgram* program, const char* name, vtkTextureObject* texture)
{
  if (program->IsUniformUsed(name))
  {
    texture->Activate();
    program->SetUniformi(name, texture->GetTextureUnit());
  }
}

} // namespace

SplatPicture::SplatPicture() = default;
SplatPicture::~SplatPicture() = default;

bool SplatPicture::showsAlready(vtkRenderer* renderer, const FramePlan& plan, bool ids) const
{
  return drawn_.renderer == renderer && drawn_.ids == ids &&
    sameCamera(drawn_.camera, plan.camera) && drawn_.clippingPlanes == plan.clippingPlanes &&
    drawn_.styles == stylesOf(plan);
}

void SplatPicture::remember(
  vtkRenderer* renderer, const FramePlan& plan, bool ids, std::int64_t points)
{
  drawn_ = { renderer, plan.camera, plan.clippingPlanes, stylesOf(plan), ids, points };
}

std::int64_t SplatPicture::draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer,
  FramePlan& plan, const GpuPool& pool, const TableOf& tableOf, bool ids, bool sameFrame)
{
  vtkOpenGLState* const state = window->GetState();
  int viewport[4];
  state->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  originPx_[0] = viewport[0];
  originPx_[1] = viewport[1];
  plan.camera.width = std::max(1, viewport[2]);
  plan.camera.height = std::max(1, viewport[3]);
  if (sameFrame && showsAlready(renderer, plan, ids))
  {
    return drawn_.points;
  }
  float sizes[2] = { 1.0f, 1.0f };
  glGetFloatv(GL_POINT_SIZE_RANGE, sizes);
  largestPointPx_ = sizes[1];
  const std::int64_t points = list(plan, pool);
  parts_ = { plan.camera.width, plan.camera.height, plan.shading.lit, ids, false };
  for (const Group& group : groups_)
  {
    parts_.blended = parts_.blended || group.first->passes.blended;
  }
  drawn_ = {};
  if (points == 0 || !target_.prepare(window, parts_))
  {
    return 0;
  }
  records_.upload(window);
  {
    const TargetState scope(state);
    state->vtkglViewport(0, 0, parts_.width, parts_.height);
    vertices_->Bind();
    target_.beginSeen();
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_LESS);
    drawGroups(window, pool, tableOf, false);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDepthMask(GL_FALSE);
    if (parts_.blended)
    {
      target_.beginSums();
      state->vtkglEnable(GL_BLEND);
      state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
      drawGroups(window, pool, tableOf, true);
      state->vtkglDisable(GL_BLEND);
    }
    target_.beginPicture();
    resolve(window, plan);
    vertices_->Release();
  }
  remember(renderer, plan, ids, points);
  groups_.clear();
  rounds_.clear();
  return points;
}

SplatPicture::Group& SplatPicture::groupOf(const Group& like)
{
  const auto found = std::find_if(groups_.begin(), groups_.end(),
    [&](const Group& group)
    {
      return group.items == like.items && group.first->style == like.first->style &&
        group.shaped == like.shaped && group.sized == like.sized && group.quads == like.quads &&
        group.mark == like.mark && group.first->passes == like.first->passes;
    });
  if (found != groups_.end())
  {
    return *found;
  }
  groups_.push_back(like);
  return groups_.back();
}

/// In the order of the nodes: of two points at one depth the first one is seen, as in the software
/// back end.
std::int64_t SplatPicture::list(const FramePlan& plan, const GpuPool& pool)
{
  groups_.clear();
  rounds_.clear();
  records_.begin(pool.slotCount());
  std::int64_t drawn = 0;
  do
  {
    const std::size_t from = rounds_.empty() ? 0 : rounds_.back()->end();
    rounds_.push_back(std::make_unique<RasterItems>(plan, from));
    for (const RasterItem& item : rounds_.back()->items())
    {
      const NodeColumns& node = item.node();
      const GpuPool::Entry* const entry = pool.find(node.node);
      const LayerStreams& layer = pool.streamsOf(node.layer);
      std::uint32_t end = entry ? std::min(item.item->last, entry->points) : 0;
      // What a mark is missing of is not shown unasked.
      end = layer.streams().marked && entry ? std::min(end, entry->values(GpuStream::Value)) : end;
      if (end <= item.item->first)
      {
        continue;
      }
      const auto isThere = [&](GpuStream stream)
      { return layer.has(stream) && entry->values(stream) >= end; };
      SlotRecords::Record record;
      record.origin =
        SlotOrigin::of(plan.grid, node.halfSize, node.origin, plan.camera.reference);
      record.coloured = isThere(GpuStream::Value);
      record.shaped = isThere(GpuStream::Shape);
      record.sized = isThere(GpuStream::Size);
      record.firstId = node.firstPoint;
      record.place = glm::vec4(
        item.camera.matrix[0][3], item.camera.matrix[1][3], item.camera.matrix[2][3], 0.0f);
      const bool bounded = !item.item->refined && !node.leaf;
      record.radii = glm::vec4(
        item.item->closingRadius, item.item->radiusScale, bounded ? 1.0f : 0.0f, 0.0f);
      records_.set(entry->slots, record);
      const bool quads = largestSplat(item, *rounds_.back()) > largestPointPx_;
      const int mark = layer.streams().marked ? layer.markOf(*item.style) : -1;
      DrawRuns& runs = groupOf({ rounds_.back().get(), &item, record.shaped, record.sized, quads,
                                 mark, {} })
                         .runs;
      pool.addRuns(*entry, item.item->first, end, runs);
      drawn += end - item.item->first;
    }
  } while (!rounds_.back()->last());
  return drawn;
}

void SplatPicture::drawGroups(vtkOpenGLRenderWindow* window, const GpuPool& pool,
  const TableOf& tableOf, bool second)
{
  for (const Group& group : groups_)
  {
    if (!second || group.first->passes.blended)
    {
      drawGroup(window, pool, tableOf, group, second);
    }
  }
}

void SplatPicture::drawGroup(vtkOpenGLRenderWindow* window, const GpuPool& pool,
  const TableOf& tableOf, const Group& group, bool second)
{
  const RasterItem& item = *group.first;
  const ResolvedStyle& style = *item.style;
  SplatVariant variant;
  variant.square = item.passes.squares;
  variant.shape = second ? item.passes.second.shape : item.passes.first.shape;
  variant.parallel = item.camera.parallel;
  variant.second = second;
  variant.marked = group.mark >= 0;
  variant.colour = variant.marked ? PointColouring::Kind::Direct : style.colouring.kind;
  variant.shaped = group.shaped;
  variant.normals =
    group.shaped && style.normalColumn && style.orientation == SplatOrientation::Normal;
  variant.radius = radiusSourceOf(item, group.shaped, group.sized);
  variant.lit = parts_.lit && !second;
  variant.ids = parts_.ids && !second;
  variant.quads = group.quads;
  vtkShaderProgram* const program = programs_.use(window, variant);
  if (!program)
  {
    return;
  }
  records_.activate(program);
  setSplatUniforms(program, *group.items, item, second);
  program->SetUniformi("styleMark", group.mark);
  float flat[4];
  std::transform(style.flat.begin(), style.flat.end(), flat,
    [](std::uint8_t value) { return static_cast<float>(value) / 255.0f; });
  program->SetUniform4f("flatColour", flat);
  const FramePlan& plan = group.items->plan();
  const float stepSize[3] = { static_cast<float>(plan.grid.scale.x),
    static_cast<float>(plan.grid.scale.y), static_cast<float>(plan.grid.scale.z) };
  program->SetUniform3f("stepSize", stepSize);
  const bool tabled = !variant.marked && style.colouring.usesTable() && style.map;
  ColourTable* const table = tabled ? tableOf(style.map) : nullptr;
  if (table)
  {
    table->activate(program, style.colouring, plan.camera.reference.z);
  }
  setTexture(program, "seenDepths", target_.seenDepths());
  {
    const SplatAttributes attributes(program, variant.colour);
    DrawBatches batches;
    for (const DrawRuns::Stretch& stretch : group.runs.stretches())
    {
      const GpuBlock& block = pool.blocks()[stretch.block];
      attributes.read(block);
      program->SetUniformi("firstSlot", static_cast<int>(block.first()));
      batches.draw(group.runs.firsts() + stretch.begin, group.runs.counts() + stretch.begin,
        stretch.end - stretch.begin);
    }
  }
  if (second)
  {
    target_.seenDepths()->Deactivate();
  }
  if (table)
  {
    table->deactivate();
  }
  records_.deactivate();
}

void SplatPicture::resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan)
{
  const FrameShading& shading = plan.shading;
  const bool eyeDome = shading.eyeDomeStrength > 0.0f;
  vtkShaderProgram* const program =
    programs_.useResolve(window, parts_.blended, parts_.lit, eyeDome);
  if (!program)
  {
    return;
  }
  const glm::dmat4& clip = plan.camera.viewToClip;
  const double nearDepth = (clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]);
  const bool parallel = plan.camera.parallel;
  program->SetUniformf("depthShift", parallel ? static_cast<float>(nearDepth) : 0.0f);
  program->SetUniformf(
    "octaveShift", parallel ? static_cast<float>(2.0 / clip[1][1] - nearDepth) : 0.0f);
  program->SetUniformf("eyeDomeStrength", eyeDomeGain * shading.eyeDomeStrength);
  program->SetUniformi(
    "eyeDomeReach", std::max(1, static_cast<int>(std::lround(shading.eyeDomeRadiusPx))));
  const int size[2] = { parts_.width, parts_.height };
  program->SetUniform2i("pictureSize", size);
  std::vector<FrameLight> lights = shading.lights;
  lights.resize(std::clamp<std::size_t>(lights.size(), 1, mostLights)); // none: one at the eye
  float towards[mostLights][3];
  float colours[mostLights][3];
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    std::copy_n(&lights[i].towards.x, 3, towards[i]);
    std::copy_n(&lights[i].colour.x, 3, colours[i]);
  }
  const auto count = static_cast<int>(lights.size());
  const float ambientDiffuse[2] = { shading.ambient, shading.diffuse };
  program->SetUniform2f("ambientDiffuse", ambientDiffuse);
  program->SetUniformi("lightCount", count);
  program->SetUniform3fv("lightTowards", count, towards);
  program->SetUniform3fv("lightColours", count, colours);
  vtkTextureObject* const textures[] = { target_.seenColours(), target_.seenDepths(),
    target_.sums(), target_.normals() };
  const char* const names[] = { "seenColours", "seenDepths", "colourSums", "seenNormals" };
  for (int i = 0; i < 4; ++i)
  {
    setTexture(program, names[i], textures[i]);
  }
  glDrawArrays(GL_TRIANGLES, 0, 3);
  for (vtkTextureObject* texture : textures)
  {
    if (texture->GetTextureUnit() >= 0)
    {
      texture->Deactivate();
    }
  }
}

void SplatPicture::handOver(
  vtkRenderer* renderer, vtkActor* actor, const FramePlan& plan, std::int64_t storePoints)
{
  if (!mapper_)
  {
    mapper_ = vtkSmartPointer<vtkOpenGLPointFrontPicture>::New();
  }
  PictureDrawing drawing;
  drawing.colour = target_.pictureColour();
  drawing.depth = target_.pictureDepth();
  drawing.ids = parts_.ids ? target_.ids() : nullptr;
  drawing.camera = &plan.camera;
  std::copy(originPx_, originPx_ + 2, drawing.originPx);
  drawing.storePoints = storePoints;
  mapper_->Draw(renderer, actor, drawing);
}

void SplatPicture::release(vtkOpenGLRenderWindow* window)
{
  target_.release(window);
  records_.release(window);
  vertices_->ReleaseGraphicsResources();
  if (mapper_)
  {
    mapper_->ReleaseGraphicsResources(window);
  }
  mapper_ = nullptr;
  drawn_ = {};
}

} // namespace pointfront
