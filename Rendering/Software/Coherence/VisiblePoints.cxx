#include "VisiblePoints.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <unordered_map>

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

/// The style that a layer's points are drawn with is one that they were drawn with.
bool drawsAlike(const FramePlan& plan, const DrawnItem& item)
{
  return std::any_of(plan.batches.begin(), plan.batches.end(),
    [&](const DrawBatch& batch)
    {
      return batch.layer == item.node->layer &&
        (batch.style.get() == item.style || *batch.style == *item.style);
    });
}

std::uint32_t wordsOf(const DrawnItem& item)
{
  return (item.last + 31) / 32;
}

} // namespace

/// A visible point, and where its values are.
struct VisiblePoints::Place
{
  std::uint32_t indexInNode;
  std::uint32_t point;
  const NodeColumns* from;
};

/// What of a drawn item was visible, a bit a point.
struct VisiblePoints::Source
{
  const DrawnItem* drawn = nullptr;
  const Kept* kept = nullptr; ///< it is not a node but points of one
  bool wanted = true;
  std::uint32_t planned = 0; ///< that many of the node's points are drawn anyway
  std::uint32_t full = 0; ///< points from there on were not of their size yet, or no more
  std::unique_ptr<std::atomic<std::uint32_t>[]> visible; ///< null: nothing is known of it

  std::uint32_t indexInNode(std::uint32_t point) const
  {
    return kept ? kept->indices[point] : point;
  }
};

VisiblePoints::VisiblePoints() = default;
VisiblePoints::~VisiblePoints() = default;

void VisiblePoints::clear()
{
  marked_.clear(); // they are of what is kept
  kept_.clear();
}

void VisiblePoints::unmark()
{
  marked_.clear();
}

std::vector<VisiblePoints::Source> VisiblePoints::sourcesOf(
  const std::vector<DrawnItem>& drawn) const
{
  std::unordered_map<const NodeColumns*, const Kept*> known;
  for (const Kept& kept : kept_)
  {
    known[kept.columns.get()] = &kept;
  }
  std::vector<Source> sources(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i)
  {
    sources[i].drawn = &drawn[i];
    const auto kept = known.find(drawn[i].node.get());
    sources[i].kept = kept == known.end() ? nullptr : kept->second;
    sources[i].full = drawn[i].growth.fullPoints(drawn[i].last);
  }
  return sources;
}

/// What the plan draws anyway, or in another way; false: it lacks nothing.
bool VisiblePoints::leaveOutPlanned(const FramePlan& plan, std::vector<Source>& sources)
{
  const std::unordered_map<NodeIndex, std::uint32_t> prefixes = prefixesOf(plan);
  bool any = false;
  for (Source& source : sources)
  {
    const DrawnItem& drawn = *source.drawn;
    const auto planned = prefixes.find(drawn.node->node);
    source.planned = planned == prefixes.end() ? 0 : planned->second;
    const bool all = !source.kept && source.planned >= drawn.last;
    source.wanted = !all && drawn.last > 0 && drawsAlike(plan, drawn);
    any = any || source.wanted;
  }
  return any;
}

void VisiblePoints::choose(const Drawn& drawn, const FramePlan& plan, ThreadCrew& crew)
{
  std::vector<Source> sources = sourcesOf(drawn.items);
  if (!leaveOutPlanned(plan, sources))
  {
    clear();
    return;
  }
  for (Source& source : sources)
  {
    if (source.wanted)
    {
      source.visible.reset(new std::atomic<std::uint32_t>[wordsOf(*source.drawn)]());
    }
  }
  markVisible(drawn, sources, crew);
  gather(sources, crew);
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
  const std::vector<Source> marked = [&]
  {
    const bool any = leaveOutPlanned(plan, marked_);
    return any ? std::move(marked_) : std::vector<Source>();
  }();
  marked_.clear();
  gather(marked, crew);
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
void VisiblePoints::gather(const std::vector<Source>& sources, ThreadCrew& crew)
{
  std::map<NodeIndex, std::vector<const Source*>> byNode;
  for (const Source& source : sources)
  {
    if (source.wanted && source.visible)
    {
      byNode[source.drawn->node->node].push_back(&source);
    }
  }
  std::vector<const std::vector<const Source*>*> nodes;
  nodes.reserve(byNode.size());
  for (const auto& [node, parts] : byNode)
  {
    nodes.push_back(&parts);
  }
  std::vector<Kept> gathered(nodes.size());
  crew.run(nodes.size(),
    [&](std::size_t number, unsigned)
    {
      const DrawnItem& drawn = *nodes[number]->front()->drawn;
      const std::vector<Place> places = placesOf(*nodes[number]);
      Kept& kept = gathered[number];
      for (const Place& place : places)
      {
        kept.indices.push_back(place.indexInNode);
      }
      kept.columns = copied(*drawn.node, places);
      kept.item.node = kept.columns;
      kept.item.last = static_cast<std::uint32_t>(places.size());
      kept.item.radiusScale = drawn.itemRadiusScale;
      kept.item.closingRadius = drawn.closingRadius;
      kept.item.sparsestRadius = drawn.sparsestRadius;
      kept.item.refined = drawn.refined;
      kept.item.unfinished = drawn.unfinished;
    });
  gathered.erase(std::remove_if(gathered.begin(), gathered.end(),
                   [](const Kept& kept) { return kept.indices.empty(); }),
    gathered.end());
  kept_ = std::move(gathered);
}

/// The visible points of one node, each once, in the node's order.
std::vector<VisiblePoints::Place> VisiblePoints::placesOf(const std::vector<const Source*>& parts)
{
  std::vector<Place> places;
  const ColumnSelection& selection = parts.front()->drawn->node->selection;
  for (const Source* part : parts)
  {
    const DrawnItem& drawn = *part->drawn;
    if (drawn.node->selection != selection)
    {
      continue;
    }
    for (std::uint32_t word = 0; word < wordsOf(drawn); ++word)
    {
      for (std::uint32_t bits = part->visible[word]; bits != 0; bits &= bits - 1)
      {
        const auto point = 32 * word + static_cast<std::uint32_t>(__builtin_ctz(bits));
        if (part->indexInNode(point) >= part->planned)
        {
          places.push_back({ part->indexInNode(point), point, drawn.node.get() });
        }
      }
    }
  }
  if (parts.size() > 1) // one part's are in order
  {
    std::sort(places.begin(), places.end(),
      [](const Place& a, const Place& b) { return a.indexInNode < b.indexInNode; });
  }
  const auto end = std::unique(places.begin(), places.end(),
    [](const Place& a, const Place& b) { return a.indexInNode == b.indexInNode; });
  places.erase(end, places.end());
  return places;
}

/// A node of these points only; all else is as in `model`.
std::shared_ptr<const NodeColumns> VisiblePoints::copied(
  const NodeColumns& model, const std::vector<Place>& places)
{
  auto columns = std::make_shared<NodeColumns>();
  columns->node = model.node;
  columns->origin = model.origin;
  columns->firstPoint = model.firstPoint;
  columns->halfSize = model.halfSize;
  columns->spacing = model.spacing;
  columns->splatRadius = model.splatRadius;
  columns->layer = model.layer;
  columns->parent = model.parent;
  columns->leaf = model.leaf;
  columns->selection = model.selection;
  columns->columns.resize(model.columns.size());
  columns->positions.reserve(places.size());
  for (const Place& place : places)
  {
    columns->positions.push_back(place.from->positions[place.point]);
  }
  for (std::size_t c = 0; c < model.columns.size(); ++c)
  {
    const std::size_t bytes = model.columns[c].size() / std::max<std::size_t>(1, model.size());
    columns->columns[c].resize(places.size() * bytes);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      std::memcpy(columns->columns[c].data() + i * bytes,
        places[i].from->columns[c].data() + places[i].point * bytes, bytes);
    }
  }
  return columns;
}

void VisiblePoints::addTo(FramePlan& plan) const
{
  for (DrawBatch& batch : plan.batches)
  {
    for (const Kept& kept : kept_)
    {
      if (kept.columns->layer == batch.layer)
      {
        batch.items.push_back(kept.item);
      }
    }
  }
}

std::uint64_t VisiblePoints::count() const
{
  std::uint64_t points = 0;
  for (const Kept& kept : kept_)
  {
    points += kept.indices.size();
  }
  return points;
}

} // namespace pointfront
