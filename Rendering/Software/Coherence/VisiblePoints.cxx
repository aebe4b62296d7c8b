#include "VisiblePoints.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <utility>

namespace pointfront
{
namespace
{

constexpr std::size_t rowsOfPiece = 16;

/// How many of a node's points a plan draws, of those it draws from the first on.
std::unordered_map<NodeIndex, std::uint32_t> prefixesOf(const FramePlan& plan)
{
  std::unordered_map<NodeIndex, std::uint32_t> prefixes;
  for (const DrawBatch& batch : plan.batches)
  {
    for (const PlanItem& item : batch.items)
    {
      std::uint32_t& prefix = prefixes[item.node->node];
      prefix = item.first == 0 ? std::max(prefix, item.last) : prefix;
    }
  }
  return prefixes;
}

/// The style of the plan that a layer's points are drawn with as before; null: there is none.
std::shared_ptr<const ResolvedStyle> styleAlike(
  const FramePlan& plan, std::uint16_t layer, const ResolvedStyle& style)
{
  const auto found = std::find_if(plan.batches.begin(), plan.batches.end(),
    [&](const DrawBatch& batch)
    { return batch.layer == layer && (batch.style.get() == &style || *batch.style == style); });
  return found == plan.batches.end() ? nullptr : found->style;
}

std::uint32_t wordsOf(const DrawnItem& item)
{
  return (item.last + 31) / 32;
}

} // namespace

/// The visible points of a drawn item, a bit a point.
struct VisiblePoints::Source
{
  const DrawnItem* drawn = nullptr;
  const KeptNode* kept = nullptr; ///< it is not a node but points of one
  std::shared_ptr<const ResolvedStyle> style; ///< the plan's style
  bool wanted = true;
  std::uint32_t planned = 0; ///< that many of the node's points are drawn anyway
  std::uint32_t full = 0; ///< points from there on were not of their size yet, or no more
  std::unique_ptr<std::atomic<std::uint32_t>[]> visible; ///< null: nothing is known of it

  std::uint32_t indexInNode(std::uint32_t point) const
  {
    return kept ? kept->indices()[point] : point;
  }
};

VisiblePoints::VisiblePoints() = default;
VisiblePoints::~VisiblePoints() = default;

void VisiblePoints::clear()
{
  marked_.clear(); // they are of what is kept
  kept_.clear();
  frame_ = 0;
}

void VisiblePoints::unmark()
{
  marked_.clear();
}

std::vector<VisiblePoints::Source> VisiblePoints::sourcesOf(
  const std::vector<DrawnItem>& drawn) const
{
  std::vector<Source> sources(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i)
  {
    sources[i].drawn = &drawn[i];
    const auto kept = kept_.find(drawn[i].node->node);
    const bool isKept = kept != kept_.end() && kept->second.columns() == drawn[i].node;
    sources[i].kept = isKept ? &kept->second : nullptr;
    sources[i].full = drawn[i].growth.fullPoints(drawn[i].last);
  }
  return sources;
}

/// Leaves out points that the plan draws anyway, or in another way; false: it lacks nothing.
bool VisiblePoints::leaveOutPlanned(
  const FramePlan& plan, const Prefixes& prefixes, std::vector<Source>& sources)
{
  bool any = false;
  for (Source& source : sources)
  {
    const DrawnItem& drawn = *source.drawn;
    const auto planned = prefixes.find(drawn.node->node);
    source.planned = source.kept || planned == prefixes.end() ? 0 : planned->second;
    source.style = styleAlike(plan, drawn.node->layer, *drawn.style);
    source.wanted = source.planned < drawn.last && source.style;
    any = any || source.wanted;
  }
  return any;
}

void VisiblePoints::choose(const Drawn& drawn, const FramePlan& plan, ThreadCrew& crew)
{
  std::vector<Source> sources = sourcesOf(drawn.items);
  const Prefixes prefixes = prefixesOf(plan);
  if (leaveOutPlanned(plan, prefixes, sources))
  {
    for (Source& source : sources)
    {
      if (source.wanted)
      {
        source.visible.reset(new std::atomic<std::uint32_t>[wordsOf(*source.drawn)]());
      }
    }
    markVisible(drawn, sources, crew);
    gather(sources, plan, crew);
  }
  leaveOutPlanned(plan, prefixes);
}

void VisiblePoints::mark(const Drawn& drawn, ThreadCrew& crew)
{
  marked_ = sourcesOf(drawn.items);
  for (Source& source : marked_)
  {
    source.visible.reset(new std::atomic<std::uint32_t>[wordsOf(*source.drawn)]());
  }
  markVisible(drawn, marked_, crew);
}

void VisiblePoints::chooseMarked(const FramePlan& plan, ThreadCrew& crew)
{
  std::vector<Source> marked = std::exchange(marked_, {});
  const Prefixes prefixes = prefixesOf(plan);
  if (leaveOutPlanned(plan, prefixes, marked))
  {
    gather(marked, plan, crew);
  }
  leaveOutPlanned(plan, prefixes);
}

void VisiblePoints::markVisible(
  const Drawn& drawn, const std::vector<Source>& sources, ThreadCrew& crew)
{
  const auto height = static_cast<std::size_t>(drawn.window.height);
  crew.run((height + rowsOfPiece - 1) / rowsOfPiece,
    [&](std::size_t piece, unsigned)
    {
      const std::size_t end = std::min(height, (piece + 1) * rowsOfPiece);
      for (std::size_t y = piece * rowsOfPiece; y < end; ++y)
      {
        markRow(drawn.keys + drawn.window.at(0, static_cast<int>(y)), drawn.window.width,
          drawn.numbers, sources);
      }
    });
}

void VisiblePoints::markRow(
  const RasterKey* row, int width, const ItemNumbers& numbers, const std::vector<Source>& sources)
{
  const Source* source = nullptr;
  std::uint32_t begin = 0, end = 0;
  for (int x = 0; x < width; ++x)
  {
    if (row[x] == emptyKey)
    {
      continue;
    }
    const auto index = static_cast<std::uint32_t>(row[x]);
    if (index < begin || index >= end)
    {
      const std::uint32_t item = numbers.itemOf(index);
      begin = numbers.beginOf(item);
      end = numbers.endOf(item);
      source = &sources[item];
    }
    const std::uint32_t point = index - begin;
    if (source->visible && point < source->full && source->indexInNode(point) >= source->planned)
    {
      // Most pixels show a point that another one marked: looking costs less than marking again.
      std::atomic<std::uint32_t>& word = source->visible[point / 32];
      const std::uint32_t bit = 1u << point % 32;
      if ((word.load(std::memory_order_relaxed) & bit) == 0)
      {
        word.fetch_or(bit, std::memory_order_relaxed);
      }
    }
  }
}

/// Visible points of one node come from the node or from what was kept of it, or both.
void VisiblePoints::gather(
  const std::vector<Source>& sources, const FramePlan& plan, ThreadCrew& crew)
{
  ++frame_;
  std::map<NodeIndex, Parts> byNode;
  for (const Source& source : sources)
  {
    if (source.wanted && source.visible)
    {
      byNode[source.drawn->node->node].push_back(&source);
    }
  }
  std::vector<std::pair<KeptNode*, const Parts*>> nodes;
  nodes.reserve(byNode.size());
  for (const auto& [node, parts] : byNode)
  {
    KeptNode& kept = kept_[node];
    kept.style = kept.style ? kept.style : parts.front()->style;
    nodes.emplace_back(&kept, &parts);
  }
  crew.run(nodes.size(),
    [&](std::size_t number, unsigned) { update(*nodes[number].first, *nodes[number].second); });
  for (auto node = kept_.begin(); node != kept_.end();)
  {
    node = node->second.indices().empty() ? kept_.erase(node) : std::next(node);
  }
  bound(kept_, std::uint64_t(plan.camera.width) * static_cast<std::uint64_t>(plan.camera.height));
}

/// The visible points of one node.
void VisiblePoints::update(KeptNode& kept, const Parts& parts) const
{
  std::vector<VisiblePoint> points;
  const Source* first = nullptr; // the first source of the node's own
  for (const Source* part : parts)
  {
    const DrawnItem& drawn = *part->drawn;
    first = first || part->kept ? first : part;
    for (std::uint32_t word = 0; word < wordsOf(drawn); ++word)
    {
      for (std::uint32_t bits = part->visible[word]; bits != 0; bits &= bits - 1)
      {
        const auto point = 32 * word + static_cast<std::uint32_t>(__builtin_ctz(bits));
        if (part->kept)
        {
          kept.sawPoint(point, frame_);
        }
        else if (point >= part->planned && drawn.node->selection == first->drawn->node->selection)
        {
          points.push_back({ point, point, drawn.node.get() });
        }
      }
    }
  }
  if (!first)
  {
    return;
  }
  const auto before = [](const VisiblePoint& a, const VisiblePoint& b)
  { return a.indexInNode < b.indexInNode; };
  std::stable_sort(points.begin(), points.end(), before); // several styles draw the same node
  const auto same = [](const VisiblePoint& a, const VisiblePoint& b)
  { return a.indexInNode == b.indexInNode; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  PlanItem as;
  as.radiusScale = first->drawn->itemRadiusScale;
  as.closingRadius = first->drawn->closingRadius;
  as.sparsestRadius = first->drawn->sparsestRadius;
  as.refined = first->drawn->refined;
  as.unfinished = first->drawn->unfinished;
  kept.add(points, as, frame_);
}

/// Points that the plan draws anyway wait until it no longer does; those it restyles go.
void VisiblePoints::leaveOutPlanned(const FramePlan& plan, const Prefixes& prefixes)
{
  for (auto node = kept_.begin(); node != kept_.end();)
  {
    KeptNode& kept = node->second;
    const auto planned = prefixes.find(node->first);
    kept.setPlanned(planned == prefixes.end() ? 0 : planned->second);
    kept.style = styleAlike(plan, kept.columns()->layer, *kept.style);
    node = kept.style ? std::next(node) : kept_.erase(node);
  }
}

void VisiblePoints::addTo(FramePlan& plan) const
{
  for (DrawBatch& batch : plan.batches)
  {
    for (const auto& [node, kept] : kept_)
    {
      if (kept.columns()->layer == batch.layer && kept.item().first < kept.item().last)
      {
        batch.items.push_back(kept.item());
      }
    }
  }
}

std::uint64_t VisiblePoints::count() const
{
  std::uint64_t points = 0;
  for (const auto& [node, kept] : kept_)
  {
    points += kept.item().last - kept.item().first;
  }
  return points;
}

} // namespace pointfront
