#include "SplatStandIns.h"

#include "GpuPool.h"
#include "OpenGLFunctions.h"
#include "RasterItems.h"
#include "SlotRecords.h"
#include "SplatGroups.h"
#include "SplatLayer.h"
#include "SplatRuns.h"

#include <vtkNew.h>
#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// Pixels of targets of levels, of one part of a picture.
constexpr std::int64_t mostPixels = std::int64_t(1) << 23;
constexpr std::int64_t mostLevels = 5;
/// The number of levels that share a target: no level that has one of its own is coarser.
constexpr int coarse = 0;

} // namespace

struct SplatStandIns::Level
{
  FramePlan plan;
  SplatGroups groups;
  SlotRecords records;
  SplatTarget target;
  bool addsNothing = false; ///< to what is in the target
  bool nodesChanged = false; ///< since their upload
  std::unordered_map<NodeIndex, std::int32_t> numbers; ///< numbers in the target
  std::vector<float> nodes; ///< 4 a number, as LayerFS.glsl reads them
  vtkNew<vtkOpenGLBufferObject> nodeBuffer;
  vtkNew<vtkTextureObject> nodeTexture;

  void release(vtkOpenGLRenderWindow* window)
  {
    target.release(window);
    records.release(window);
    nodeTexture->ReleaseGraphicsResources(window);
    nodeBuffer->ReleaseGraphicsResources();
    groups.forget();
  }
  void uploadNodes(vtkOpenGLRenderWindow* window)
  {
    nodeBuffer->Upload(nodes.data(), nodes.size(), vtkOpenGLBufferObject::TextureBuffer);
    nodeTexture->ReleaseGraphicsResources(window); // its size may be another
    nodeTexture->SetContext(window);
    nodeTexture->SetInternalFormat(GL_RGBA32F);
    nodeTexture->SetFormat(GL_RGBA);
    nodeTexture->CreateTextureBuffer(
      static_cast<unsigned int>(nodes.size() / 4), 4, VTK_FLOAT, nodeBuffer);
  }
};

SplatStandIns::SplatStandIns() = default;
SplatStandIns::~SplatStandIns() = default;

/// A plan of each target's stand-ins, by number.
std::map<int, FramePlan> SplatStandIns::plansOf(const FramePlan& plan)
{
  std::set<int, std::greater<int>> numbers;
  for (const DrawBatch& batch : plan.standIns)
  {
    numbers.insert(1 + batch.level);
  }
  const std::int64_t pixels = std::int64_t(plan.camera.width) * plan.camera.height;
  const auto own =
    static_cast<std::size_t>(std::clamp<std::int64_t>(mostPixels / pixels, 1, mostLevels));
  while (numbers.size() >= own && numbers.size() > 1)
  {
    numbers.erase(std::prev(numbers.end()));
  }
  std::map<int, FramePlan> plans;
  for (const DrawBatch& batch : plan.standIns)
  {
    const int number = numbers.count(1 + batch.level) > 0 ? 1 + batch.level : coarse;
    const auto [place, isNew] = plans.try_emplace(number);
    if (isNew)
    {
      static_cast<FrameSetting&>(place->second) = plan;
    }
    place->second.batches.push_back(batch);
  }
  return plans;
}

/// Gives the nodes of a level numbers, which those that are in the target have already, and tells
/// what shows them.
void SplatStandIns::number(Level& level)
{
  const std::vector<float> before = std::move(level.nodes);
  level.nodes.clear();
  if (!level.groups.goesOn())
  {
    level.numbers.clear();
  }
  level.groups.forEach(
    [&](const RasterItem& item, const GpuPool::Entry& entry)
    {
      const auto next = static_cast<std::int32_t>(level.numbers.size());
      const std::int32_t number = level.numbers.insert({ item.node().node, next }).first->second;
      level.records.setNumber(entry.slots, number);
      level.nodes.resize(4 * level.numbers.size(), 0.0f);
      float* const node = level.nodes.data() + std::size_t(4) * static_cast<std::size_t>(number);
      node[0] = item.item->covered ? -1.0f : std::max(node[0], item.radius);
      node[1] = std::max(node[1], item.passes.first.leastRadius / item.camera.scaleY);
    });
  level.nodesChanged = level.nodesChanged || before != level.nodes;
}

void SplatStandIns::list(
  const SplatFrame& frame, const FramePlan& plan, float largestPointPx, bool samePlace, bool lit)
{
  parts_ = { plan.camera.width, plan.camera.height, lit, false, false, true, false };
  std::map<int, FramePlan> plans = plansOf(plan);
  changed_ = false;
  shown_ = {};
  for (auto each = levels_.begin(); each != levels_.end();)
  {
    const bool stays = plans.count(each->first) > 0;
    stays ? void() : each->second->release(frame.window);
    changed_ = changed_ || !stays;
    each = stays ? std::next(each) : levels_.erase(each);
  }
  for (auto& [number, ofLevel] : plans)
  {
    std::unique_ptr<Level>& place = levels_[number];
    place = place ? std::move(place) : std::make_unique<Level>();
    Level& level = *place;
    level.plan = std::move(ofLevel);
    const bool goesOn = samePlace && level.target.has(parts_);
    level.groups.list(level.plan, *frame.pool, largestPointPx, goesOn, level.records);
    level.addsNothing = level.groups.goesOn() && level.groups.addsNothing();
    this->number(level);
    changed_ = changed_ || !level.addsNothing || level.nodesChanged;
    shown_ = around(shown_, level.groups.shown());
  }
}

/// False where there is nothing to put.
bool SplatStandIns::draw(
  const SplatFrame& frame, SplatTools& tools, const PixelRectangle& limits, Level& level)
{
  if (!level.addsNothing && !level.target.prepare(frame.window, parts_))
  {
    level.groups.forget();
    return false;
  }
  if (level.nodesChanged && !level.nodes.empty())
  {
    level.uploadNodes(frame.window);
  }
  level.nodesChanged = false;
  if (!level.addsNothing)
  {
    vtkOpenGLState* const state = frame.window->GetState();
    level.records.upload(frame.window);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglDisable(GL_SCISSOR_TEST);
    level.target.beginSeen(!level.groups.goesOn());
    state->vtkglEnable(GL_SCISSOR_TEST);
    state->vtkglScissor(limits.left, limits.bottom, limits.width(), limits.height());
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_LESS);
    for (const SplatGroups::Group& group : level.groups.groups())
    {
      const DrawRuns& runs = level.groups.goesOn() ? group.added : group.all;
      SplatVariant variant = variantOf(group, parts_, false);
      variant.standIn = true;
      vtkShaderProgram* const program =
        runs.stretches().empty() ? nullptr : tools.programs.use(frame.window, variant);
      if (program)
      {
        drawSplatRuns(frame, level.records, program, variant, group, runs);
      }
    }
  }
  level.groups.keep(level.plan);
  return !level.nodes.empty();
}

SeenTextures SplatStandIns::over(const SplatFrame& frame, SplatTools& tools,
  const SplatTarget::Parts& parts, const PixelRectangle& limits, SeenTextures seen)
{
  for (auto& [number, level] : levels_)
  {
    if (draw(frame, tools, limits, *level))
    {
      const SplatLayer layer{ level->target.seen(), level->nodeTexture,
        level->plan.camera.parallel };
      putLayer(frame, tools, parts, limits, layer, seen); // else there are holes for a while
    }
  }
  return seen;
}

void SplatStandIns::forget()
{
  for (auto& [number, level] : levels_)
  {
    level->groups.forget();
  }
}

void SplatStandIns::release(vtkOpenGLRenderWindow* window)
{
  for (auto& [number, level] : levels_)
  {
    level->release(window);
  }
  levels_.clear();
}

} // namespace pointfront
