#include "MapperFronts.h"

#include "PerWindow.h"

#include "pointfront/Store/StoredCloud.h"

#include <vtkRenderWindow.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace pointfront
{

void MapperFronts::setStore(vtkPointFrontStore* store)
{
  if (store != store_)
  {
    succession_.reset();
    views_.clear();
    piece_.reset();
    store_ = store;
  }
}

void MapperFronts::setPiece(int piece, int pieces)
{
  if (piece_ && pieceNumber_ == piece && pieces_ == pieces)
  {
    return;
  }
  succession_.reset();
  views_.clear();
  pieceNumber_ = piece;
  pieces_ = pieces;
  piece_ = std::make_shared<HierarchyPiece>(
    store_->GetStore()->hierarchy(), std::clamp(piece, 0, pieces - 1), pieces);
}

RendererFront& MapperFronts::of(vtkRenderer* renderer, vtkActor* actor)
{
  for (auto view = views_.begin(); view != views_.end();)
  {
    const bool there = view->second.Renderer && view->second.Actor;
    view = there ? std::next(view) : views_.erase(view);
  }
  const auto key = std::make_pair(renderer, actor);
  const auto found = views_.find(key);
  if (found != views_.end())
  {
    return found->second;
  }
  const auto left = [this]
  {
    if (!isSeen())
    {
      unseen_();
    }
  };
  return views_.try_emplace(key, renderer, actor, left).first->second; // they stay where they are
}

RendererFront* MapperFronts::find(vtkRenderer* renderer, vtkActor* actor)
{
  const auto view = views_.find({ renderer, actor });
  return view != views_.end() ? &view->second : nullptr;
}

FrameStatistics MapperFronts::statisticsOf(vtkRenderer* renderer) const
{
  std::optional<FrameStatistics> all;
  for (const auto& [key, view] : views_)
  {
    if (key.first == renderer && view.Renderer && view.Actor && !view.NewFrame)
    {
      all ? all->add(view.Statistics) : void(all = view.Statistics);
    }
  }
  return all.value_or(FrameStatistics());
}

/// The fronts of a frame refer to their store.
bool MapperFronts::isBetweenFrames(vtkRenderer* renderer) const
{
  return std::all_of(views_.begin(), views_.end(),
    [&](const auto& view) { return view.first.first != renderer || view.second.NewFrame; });
}

bool MapperFronts::openFront(vtkRenderer* renderer, RendererFront& view)
{
  if (view.View.front())
  {
    return false;
  }
  view.View.open(std::make_unique<ViewFront>(piece_, store_->GetResidencyShare(),
    store_->GetStore()->description().schema,
    perWindow<WindowDemand>(renderer->GetRenderWindow())));
  return true;
}

bool MapperFronts::isSeen() const
{
  return std::any_of(views_.begin(), views_.end(),
    [](const auto& view) { return view.second.Renderer && view.second.Actor && view.second.Seen; });
}

std::uint32_t MapperFronts::countIn(vtkWindow* window) const
{
  return static_cast<std::uint32_t>(std::count_if(views_.begin(), views_.end(),
    [&](const auto& view)
    { return view.second.Renderer && view.second.Renderer->GetRenderWindow() == window; }));
}

std::uint64_t MapperFronts::pointsOnGpu(vtkWindow* window, std::uint64_t budget) const
{
  std::uint64_t points = 0;
  for (const auto& [key, view] : views_)
  {
    const ViewFront* const front = view.View.front();
    const bool inside = front && view.Renderer && view.Renderer->GetRenderWindow() == window;
    points += inside ? front->pointsOnGpu(budget) : 0;
  }
  return points;
}

bool MapperFronts::needsRender()
{
  if (!views_.empty() && !isSeen())
  {
    return false;
  }
  if (succession_ ? succession_->wantsUpdate() : store_ && store_->HasSuccessor())
  {
    return true;
  }
  bool needed = false;
  for (auto& [key, view] : views_)
  {
    needed = (view.Renderer && view.Actor && view.NeedsRender()) || needed;
  }
  return needed;
}

bool MapperFronts::follow(vtkRenderer* renderer, vtkActor* actor,
  const std::function<FrameRequest()>& requestOf, const LayersOf& layersOf)
{
  if (!store_ || !store_->IsPreview() || !isBetweenFrames(renderer))
  {
    return false;
  }
  if (!succession_)
  {
    auto next = store_->GetSuccessor();
    if (!next)
    {
      return false;
    }
    succession_ = std::make_unique<StoreSuccession>(
      next, *store_, std::clamp(pieceNumber_, 0, pieces_ - 1), pieces_);
  }
  const RendererFront* const viewing = &of(renderer, actor);
  for (auto& [key, view] : views_) // others may not be rendered for a while
  {
    if (view.View.front() || &view == viewing)
    {
      FrameRequest wanted = &view == viewing ? requestOf() : view.View.request();
      wanted.layers = layersOf(*succession_->store());
      succession_->advance(&view, std::move(wanted));
    }
  }
  const auto shown = [&](const auto& view)
  {
    const RendererFront& one = view.second;
    return !one.View.front() || !one.Renderer || !one.Actor || succession_->ready(&one);
  };
  const bool all = std::all_of(views_.begin(), views_.end(), shown);
  if (all)
  {
    takeSuccessor();
  }
  return all;
}

void MapperFronts::takeSuccessor()
{
  const std::unique_ptr<StoreSuccession> succession = std::move(succession_);
  for (auto& [key, view] : views_)
  {
    view.View.open(succession->take(&view));
    view.Plan.reset();
    view.Announced = false;
    if (view.View.front() && view.Renderer)
    {
      view.View.front()->enterWindow(perWindow<WindowDemand>(view.Renderer->GetRenderWindow()));
    }
  }
  piece_ = succession->piece();
  store_ = succession->store();
}

} // namespace pointfront
