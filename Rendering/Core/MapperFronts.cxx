#include "MapperFronts.h"

#include "PerWindow.h"

#include "pointfront/Store/StoredCloud.h"

#include <vtkRenderWindow.h>

#include <algorithm>
#include <iterator>
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

RendererFront& MapperFronts::of(vtkRenderer* renderer)
{
  for (auto view = views_.begin(); view != views_.end();)
  {
    view = view->second.Renderer ? std::next(view) : views_.erase(view);
  }
  const auto found = views_.find(renderer);
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
  return views_.try_emplace(renderer, renderer, left).first->second; // a map's stay where they are
}

RendererFront* MapperFronts::find(vtkRenderer* renderer)
{
  const auto view = views_.find(renderer);
  return view != views_.end() ? &view->second : nullptr;
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
    [](const auto& view) { return view.second.Renderer && view.second.Seen; });
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
  for (const auto& [renderer, view] : views_)
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
  for (auto& [renderer, view] : views_)
  {
    needed = (view.Renderer && view.NeedsRender()) || needed;
  }
  return needed;
}

bool MapperFronts::follow(
  vtkRenderer* renderer, const std::function<FrameRequest()>& requestOf, const LayersOf& layersOf)
{
  // Between frames only: the fronts of a frame refer to their store.
  if (!store_ || !store_->IsPreview() || !of(renderer).NewFrame)
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
  for (auto& [viewing, view] : views_) // others may not be rendered for a while
  {
    if (view.View.front() || viewing == renderer)
    {
      FrameRequest wanted = viewing == renderer ? requestOf() : view.View.request();
      wanted.layers = layersOf(*succession_->store());
      succession_->advance(viewing, std::move(wanted));
    }
  }
  const auto shown = [&](const auto& view)
  { return !view.second.View.front() || !view.second.Renderer || succession_->ready(view.first); };
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
  for (auto& [renderer, view] : views_)
  {
    view.View.open(succession->take(renderer));
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
