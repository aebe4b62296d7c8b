#include "LastPicture.h"

#include "SameCamera.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{

bool contains(const RasterWindow& window, const RasterWindow& other)
{
  return window.rectangle().contains(other.rectangle());
}

/// The item is what was drawn before, or that and more of its points. Only what pixels are made of
/// counts: a tree that is being loaded changes what its nodes say of each other frame by frame.
bool continues(const RasterItem& item, const DrawnItem& drawn)
{
  SizeTerms size = item.sizeTerms();
  const bool atFullSize = size.growth.fullPoints(item.item->last) >= drawn.last;
  size.growth = atFullSize ? PointGrowth() : size.growth;
  return item.item->node == drawn.node &&
    (item.style == drawn.style || *item.style == *drawn.style) && item.passes == drawn.passes &&
    item.item->first == drawn.first && item.item->last >= drawn.last && size == drawn.size;
}

/// Up to where the item's points stay as they are drawn, of which the first ones are there.
std::uint32_t lastingUpTo(const RasterItem& item, std::uint32_t there)
{
  const PlanItem& planned = *item.item;
  return planned.covered ? there
                         : std::max(there, item.sizeTerms().growth.fullPoints(planned.last));
}

} // namespace

VisiblePoints::Drawn LastPicture::drawn(const RasterKey* keys) const
{
  return { keys, window_, numbers_, items_ };
}

bool LastPicture::isOf(const FramePlan& plan) const
{
  return sameCamera(camera_, plan.camera) && clippingPlanes_ == plan.clippingPlanes;
}

/// From the same camera it is what it was: the picture goes on from there.
const VisiblePoints& LastPicture::visibleFor(const FramePlan& plan, bool wanted, ThreadCrew& crew)
{
  const bool follows = wanted && known_ && grid_ == plan.grid && *schema_ == *plan.schema;
  if (!follows)
  {
    visible_.clear();
  }
  else if (!isOf(plan))
  {
    valid_ ? visible_.choose(drawn(keys_.data()), plan, crew) : visible_.chooseMarked(plan, crew);
  }
  return visible_;
}

/// Whether all that was drawn is part of the new items; then keys get the new items' numbers, and
/// `drawnUpTo` says for each item which of its points are there.
bool LastPicture::renumber(
  const RasterItems& items, ThreadCrew& crew, std::vector<std::uint32_t>& drawnUpTo)
{
  const std::vector<RasterItem>& now = items.items();
  drawnUpTo.assign(now.size(), 0);
  std::vector<std::uint32_t> shift(items_.size());
  bool moved = false;
  std::size_t next = 0;
  for (std::size_t old = 0; old < items_.size(); ++old, ++next)
  {
    while (next < now.size() && !continues(now[next], items_[old]))
    {
      ++next;
    }
    if (next == now.size())
    {
      return false;
    }
    drawnUpTo[next] = items_[old].last;
    shift[old] = now[next].base - items_[old].base;
    moved = moved || shift[old] != 0;
  }
  if (!moved)
  {
    return true;
  }
  RasterKey* const keys = keys_.data();
  const auto renumbered = [&](RasterKey key)
  {
    const auto index = static_cast<std::uint32_t>(key);
    const auto after = std::upper_bound(items_.begin(), items_.end(), index,
      [](std::uint32_t i, const DrawnItem& item) { return i < item.base; });
    const std::uint32_t by = shift[static_cast<std::size_t>(after - items_.begin()) - 1];
    return static_cast<RasterKey>(
      (static_cast<std::uint64_t>(key) & 0xffffffff00000000u) | (index + by));
  };
  crew.run(static_cast<std::size_t>(window_.height),
    [&](std::size_t y, unsigned)
    {
      RasterKey* const row = keys + window_.at(0, static_cast<int>(y));
      for (int x = 0; x < window_.width; ++x)
      {
        row[x] = row[x] == emptyKey ? emptyKey : renumbered(row[x]);
      }
    });
  return true;
}

bool LastPicture::goOn(const RasterItems& items, RasterWindow& window, ThreadCrew& crew,
  std::vector<std::uint32_t>& drawnUpTo)
{
  if (!valid_ || !contains(window_, window) || !isOf(items.plan()) ||
    !renumber(items, crew, drawnUpTo))
  {
    return false;
  }
  window = window_;
  return true;
}

LastPicture::Pieces LastPicture::begin(
  const RasterItems& items, RasterWindow& window, ThreadCrew& crew, const PixelRectangle& most)
{
  Pieces pieces;
  std::vector<std::uint32_t> drawnUpTo;
  pieces.goesOn = most.contains(window_.rectangle()) && goOn(items, window, crew, drawnUpTo);
  drawnUpTo.resize(items.items().size(), 0u);
  lastingUpTo_.clear();
  for (std::size_t i = 0; i < items.items().size(); ++i)
  {
    const RasterItem& item = items.items()[i];
    const PlanItem& planned = *item.item;
    const std::uint32_t from = std::max(planned.first, pieces.goesOn ? drawnUpTo[i] : 0u);
    const std::uint32_t end =
      items.plan().refining ? std::max(from, lastingUpTo(item, from)) : planned.last;
    pieces.reused += item.passes.walls() ? 0 : from - planned.first;
    const std::uint32_t last = planned.covered ? end : planned.last;
    pieces.drawn += item.passes.walls() ? 0 : last - from;
    addPieces(item, planned.first, from, pieces.there);
    addPieces(item, from, end, pieces.lasting);
    addPieces(item, end, last, pieces.passing);
    lastingUpTo_.push_back(end);
  }
  return pieces;
}

RasterBuffer<RasterKey> LastPicture::takeKeys()
{
  valid_ = false;
  return std::exchange(keys_, RasterBuffer<RasterKey>());
}

void LastPicture::note(const RasterItems& items, const RasterWindow& window)
{
  const FramePlan& plan = items.plan();
  known_ = true;
  camera_ = plan.camera;
  clippingPlanes_ = plan.clippingPlanes;
  grid_ = plan.grid;
  schema_ = plan.schema;
  window_ = window;
  numbers_ = items.numbers();
  items_.clear();
  for (std::size_t i = 0; i < items.items().size(); ++i)
  {
    const RasterItem& item = items.items()[i];
    SizeTerms size = item.sizeTerms();
    size.growth = plan.refining ? PointGrowth() : size.growth;
    items_.push_back({ item.item->node, item.style, item.passes, item.base, item.item->first,
      lastingUpTo_[i], size, item.item->refined, item.item->unfinished, item.item->closingRadius,
      item.item->sparsestRadius, item.item->radiusScale, item.item->growth });
  }
  styles_.clear();
  for (const DrawBatch& batch : plan.batches)
  {
    styles_.push_back(batch.style);
  }
}

void LastPicture::keep(const RasterItems& items, const RasterWindow& window,
  RasterBuffer<RasterKey> keys, BlendedSums sums)
{
  visible_.unmark();
  note(items, window);
  keys_ = std::move(keys);
  sums_ = std::move(sums);
  valid_ = true;
}

void LastPicture::keepVisible(
  const RasterItems& items, const RasterWindow& window, const RasterKey* keys, ThreadCrew& crew)
{
  visible_.unmark();
  note(items, window);
  valid_ = false;
  sums_ = {};
  visible_.mark(drawn(keys), crew);
}

void LastPicture::forget()
{
  known_ = false;
  valid_ = false;
  sums_ = {};
  visible_.clear();
}

} // namespace pointfront
