#include "WindowDrawing.h"

#include "GpuAccount.h"
#include "PerWindow.h"

#include "pointfront/Plan/SlotOrigin.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace pointfront
{
namespace
{

/// From the reference point to the box of a node, as far as its sphere says.
float distanceTo(const PlanItem& item, const FramePlan& plan)
{
  const NodeColumns& node = *item.node;
  const SlotOrigin origin =
    SlotOrigin::of(plan.grid, node.halfSize, node.origin, plan.camera.reference);
  const glm::vec3 centre =
    origin.relative(glm::u32vec3(0), glm::vec3(plan.grid.scale)) + node.halfSize;
  return std::max(0.0f, glm::length(centre) - glm::length(node.halfSize));
}

/// Whether points have not grown to their size. A selection shows them as if they had.
bool isGrowing(const FramePlan& plan)
{
  const auto grows = [](const PlanItem& item) { return !item.growth.whole(); };
  return std::any_of(plan.batches.begin(), plan.batches.end(),
    [&](const DrawBatch& batch)
    { return std::any_of(batch.items.begin(), batch.items.end(), grows); });
}

} // namespace

bool FrameTimer::begin(double cpuMilliseconds, std::int64_t moves)
{
  if (gpu_.Started())
  {
    return false;
  }
  frame_ = { 0, moves, 0.0 };
  cpuMs_ = cpuMilliseconds;
  gpu_.Start();
  return true;
}

void FrameTimer::end(double drawingMilliseconds, std::int64_t points)
{
  gpu_.Stop();
  frame_.points = points;
  drawingMs_ = drawingMilliseconds;
}

std::optional<FrameTimer::Frame> FrameTimer::take()
{
  if (!gpu_.Started() || !gpu_.Stopped() || !gpu_.Ready())
  {
    return std::nullopt;
  }
  frame_.milliseconds = cpuMs_ + std::max<double>(drawingMs_, gpu_.GetElapsedMilliseconds());
  gpu_.Reset();
  return frame_;
}

WindowDrawing::WindowDrawing(vtkOpenGLRenderWindow* window)
  : window_(window)
{
  resources_->SetReleaseFunction([this] { this->release(); });
}

WindowDrawing::~WindowDrawing()
{
  release();
  resources_->SetReleaseFunction(nullptr);
}

void WindowDrawing::enter(vtkRenderer* renderer, vtkActor* actor)
{
  resources_->Enter(renderer, actor);
  pool_.enter(perWindow<GpuAccount>(window_));
}

void WindowDrawing::release()
{
  if (!window_)
  {
    return; // its context is gone, and has told before
  }
  window_->PushContext();
  pool_.release();
  records_.release(window_);
  for (const auto& table : tables_)
  {
    table->release(window_);
  }
  tables_.clear();
  for (auto& pass : passes_)
  {
    if (pass)
    {
      pass->ReleaseGraphicsResources(window_);
    }
    pass = nullptr;
  }
  picture_.release(window_);
  splats_.release(window_);
  selection_.release(window_);
  for (auto& [view, own] : timers_)
  {
    own.timer.release();
  }
  timers_.clear();
  window_->PopContext();
}

/// Drops those of actors that are gone: another one may have the same address.
FrameTimer& WindowDrawing::timerOf(vtkRenderer* renderer, vtkActor* actor)
{
  for (auto own = timers_.begin(); own != timers_.end();)
  {
    if (own->second.actor)
    {
      ++own;
      continue;
    }
    own->second.timer.release();
    own = timers_.erase(own);
  }
  ActorTimer& own = timers_[{ renderer, actor }];
  own.actor = actor;
  return own.timer;
}

void WindowDrawing::leaveScreen()
{
  pool_.leaveScreen();
  picture_.leaveScreen();
}

void WindowDrawing::setStore(const void* store)
{
  if (store_ != store)
  {
    pool_.release();
    picture_.leaveScreen();
    streams_.clear();
    store_ = store;
  }
}

/// Batches have their items near to far each; those of several are put together by distance.
void WindowDrawing::order(const FramePlan& plan)
{
  struct PlacedItem
  {
    float distance;
    const PlanItem* item;
    const ResolvedStyle* style;
  };
  std::vector<PlacedItem> places;
  for (const DrawBatch& batch : plan.batches)
  {
    for (const PlanItem& item : batch.items)
    {
      const float distance = plan.batches.size() > 1 ? distanceTo(item, plan) : 0.0f;
      places.push_back({ distance, &item, batch.style.get() });
    }
  }
  if (plan.batches.size() > 1)
  {
    std::sort(places.begin(), places.end(),
      [](const PlacedItem& a, const PlacedItem& b)
      {
        return a.distance != b.distance ? a.distance < b.distance
                                        : a.item->node->node < b.item->node->node;
      });
  }
  order_.clear();
  styles_.clear();
  for (const PlacedItem& place : places)
  {
    order_.push_back(place.item);
    styles_.push_back(place.style);
  }
  wanted_ = order_;
  std::unordered_set<NodeIndex> listed;
  for (const PlanItem* const item : order_)
  {
    listed.insert(item->node->node);
  }
  for (const DrawBatch& batch : plan.standIns)
  {
    for (const PlanItem& item : batch.items)
    {
      listed.insert(item.node->node).second ? wanted_.push_back(&item) : void();
    }
  }
}

bool WindowDrawing::upload(const FramePlan& plan, std::int64_t bytes)
{
  this->order(plan);
  this->chooseStreams(plan);
  const bool room = pool_.makeRoom(wanted_);
  bool left = false;
  for (const PlanItem* const item : wanted_)
  {
    const auto* entry = pool_.bring(*item->node, item->last, plan, bytes);
    left = left || !entry || !pool_.isFilled(*entry, item->last);
  }
  // Points without room do not come with another frame, unless clouds that are drawn after this one
  // have yet to come down to a budget that was lowered.
  return left && (room || bytes <= 0 || pool_.lowered());
}

/// A layer that shows nothing in this frame keeps what it has. Stand-ins may come before all nodes
/// of their layer that the plan has items of.
void WindowDrawing::chooseStreams(const FramePlan& plan)
{
  std::map<std::uint16_t, LayerStreams::Styles> byLayer;
  for (const DrawBatch& batch : plan.batches)
  {
    byLayer[batch.layer].push_back(batch.style);
  }
  std::map<std::uint16_t, LayerStreams::Styles> ofStandIns;
  for (const DrawBatch& batch : plan.standIns)
  {
    LayerStreams::Styles& styles = ofStandIns[batch.layer];
    const bool isNew = std::find(styles.begin(), styles.end(), batch.style) == styles.end();
    isNew ? styles.push_back(batch.style) : void();
  }
  byLayer.merge(ofStandIns); // layers that have none yet
  for (auto& [layer, styles] : byLayer)
  {
    streams_.resize(std::max<std::size_t>(streams_.size(), layer + 1u));
    streams_[layer] = LayerStreams(std::move(styles));
  }
  pool_.setStreams(streams_);
}

DrawRuns& WindowDrawing::runsOf(const std::shared_ptr<const ResolvedStyle>& style)
{
  const auto found = std::find_if(
    groups_.begin(), groups_.end(), [&](const StyleGroup& group) { return group.style == style; });
  if (found != groups_.end())
  {
    return found->runs;
  }
  groups_.push_back({ style, {} });
  return groups_.back().runs;
}

std::int64_t WindowDrawing::list(const FramePlan& plan)
{
  this->order(plan);
  groups_.clear();
  for (const DrawBatch& batch : plan.batches)
  {
    this->runsOf(batch.style); // in the order of the batches
  }
  records_.begin(pool_.memory().slotCount());
  std::int64_t drawn = 0;
  for (std::size_t i = 0; i < order_.size(); ++i)
  {
    const PlanItem& item = *order_[i];
    const NodeColumns& node = *item.node;
    const auto* entry = pool_.find(node.node);
    const std::uint32_t end = entry ? std::min(item.last, entry->points) : 0;
    if (end <= item.first)
    {
      continue;
    }
    SlotRecords::Record record;
    record.origin = SlotOrigin::of(plan.grid, node.halfSize, node.origin, plan.camera.reference);
    record.coloured = styles_[i]->colouring.hasValues() && entry->values(GpuStream::Value) >= end;
    record.firstId = node.firstPoint;
    records_.set(entry->slots, record);
    const auto group = std::find_if(groups_.begin(), groups_.end(),
      [&](const StyleGroup& each) { return each.style.get() == styles_[i]; });
    pool_.addRuns(*entry, item.first, end, group->runs);
    drawn += end - item.first;
  }
  return drawn;
}

void WindowDrawing::dropTables(const FramePlan& plan)
{
  const auto unused = [&](const std::unique_ptr<ColourMapTexture>& table)
  {
    const auto reads = [&](const DrawBatch& batch) { return batch.style->map == table->map(); };
    const bool used = std::any_of(plan.batches.begin(), plan.batches.end(), reads) ||
      std::any_of(plan.standIns.begin(), plan.standIns.end(), reads);
    if (!used)
    {
      table->release(window_);
    }
    return !used;
  };
  tables_.erase(std::remove_if(tables_.begin(), tables_.end(), unused), tables_.end());
}

std::int64_t WindowDrawing::drawSplats(
  vtkRenderer* renderer, FramePlan& plan, bool ids, bool unfinished)
{
  this->dropTables(plan);
  const bool apart = ids && refines_ && (!plan.refining || isGrowing(plan));
  if (!ids)
  {
    drawn_ == &selection_ ? selection_.release(window_) : void();
    refines_ = plan.refining;
  }
  drawn_ = apart ? &selection_ : &splats_;
  return drawn_->draw(
    window_, renderer, plan, pool_,
    [this](const std::shared_ptr<const ColourMap>& map) { return this->tableOf(map); }, ids,
    unfinished);
}

ColourMapTexture* WindowDrawing::tableOf(const std::shared_ptr<const ColourMap>& map)
{
  for (const auto& table : tables_)
  {
    if (table->map() == map)
    {
      return table.get();
    }
  }
  tables_.push_back(std::make_unique<ColourMapTexture>());
  tables_.back()->update(window_, map);
  return tables_.back().get();
}

vtkOpenGLPointFrontPoints& WindowDrawing::passOf(PointColouring::Kind kind)
{
  auto& pass = passes_[static_cast<std::size_t>(kind)];
  if (!pass)
  {
    pass = vtkSmartPointer<vtkOpenGLPointFrontPoints>::New();
  }
  return *pass;
}

void WindowDrawing::draw(vtkRenderer* renderer, vtkActor* actor, vtkMapper* owner,
  const FramePlan& plan, std::int64_t storePoints)
{
  this->dropTables(plan);
  records_.upload(window_);
  PointDrawing drawing;
  drawing.pool = &pool_;
  drawing.records = &records_;
  drawing.stepSize = plan.grid.scale;
  drawing.storePoints = storePoints;
  drawing.reference = plan.camera.reference;
  for (StyleGroup& group : groups_)
  {
    if (group.runs.stretches().empty())
    {
      continue;
    }
    const ResolvedStyle& style = *group.style;
    drawing.colouring = style.colouring;
    drawing.table = style.map ? this->tableOf(style.map) : nullptr;
    drawing.flat = style.flat;
    drawing.pointSize = style.size.mode == SplatSize::Mode::Pixels ? style.size.value : 0.0;
    drawing.runs = &group.runs;
    vtkOpenGLPointFrontPoints& pass = this->passOf(style.colouring.kind);
    pass.CopyState(owner);
    pass.Draw(renderer, actor, drawing);
  }
}

} // namespace pointfront
