#include "pointfront/Collection/HeadTree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{
namespace
{
int longestAxis(const Bounds& box)
{
  const glm::dvec3 size = box.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Halves a list at the median of the centres along the longest axis of them all. `itemOf` gives
/// the leaf or the group of an entry.
template <typename T, typename ItemOf>
std::vector<T> halved(std::vector<T>& entries, const ItemOf& itemOf)
{
  Bounds centres;
  for (const T& entry : entries)
  {
    centres.add(itemOf(entry).box.centre());
  }
  const int axis = longestAxis(centres);
  const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(entries.size() / 2);
  std::stable_sort(entries.begin(), entries.end(),
    [&](const T& a, const T& b)
    { return itemOf(a).box.centre()[axis] < itemOf(b).box.centre()[axis]; });
  std::vector<T> behind(std::make_move_iterator(middle), std::make_move_iterator(entries.end()));
  entries.erase(middle, entries.end());
  return behind;
}

/// Deals each head's share of `most` points, by its area, to a group; all that is left where `most`
/// is 0.
void deal(HeadItem& group, const std::vector<TileHead*>& heads, std::uint32_t most)
{
  double all = 0.0;
  for (const TileHead* head : heads)
  {
    all += head->leaf->area;
  }
  double carried = 0.0;
  for (TileHead* const head : heads)
  {
    const std::size_t left = head->points.size() - head->taken;
    const double share = most * head->leaf->area / all + carried;
    const auto whole = static_cast<std::size_t>(share);
    carried = share - std::floor(share);
    const std::size_t count = most == 0 ? left : std::min(left, whole);
    group.points->append(head->points, head->taken, head->taken + count);
    head->taken += count;
  }
}

std::unique_ptr<HeadItem> emptyGroup()
{
  auto group = std::make_unique<HeadItem>();
  group->points = std::make_unique<HeadPoints>();
  return group;
}

double distanceTo(const Bounds& box, const glm::dvec3& p)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double d = std::max({ box.low[axis] - p[axis], 0.0, p[axis] - box.high[axis] });
    sum += d * d;
  }
  return sum;
}

/// The child whose box is nearest to a place, by its centre among those that hold it.
HeadItem& nearestChild(const HeadItem& group, const glm::dvec3& place)
{
  const auto cost = [&](const std::unique_ptr<HeadItem>& child)
  {
    const glm::dvec3 d = child->box.centre() - place;
    return std::pair(distanceTo(child->box, place), glm::dot(d, d));
  };
  return **std::min_element(group.children.begin(), group.children.end(),
    [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
}

void collectTiles(const HeadItem& item, std::unordered_set<std::uint32_t>& tiles)
{
  if (item.leaf)
  {
    tiles.insert(item.tile);
  }
  for (const auto& child : item.children)
  {
    collectTiles(*child, tiles);
  }
}

/// A number from 0 to 1 that is the tile's own at each depth: it decides about fractions of points.
double fractionOf(std::uint32_t tile, std::size_t depth)
{
  std::uint32_t h = tile * 0x9e3779b1u + static_cast<std::uint32_t>(depth) * 0x85ebca6bu;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  return h / 4294967296.0;
}

/// The area that the points of a root lie on, by their spacing.
double rootArea(const Node& row)
{
  const double bySpacing = double(row.spacing) * row.spacing * row.pointCount;
  const double byBox = 4.0 * double(row.halfSize.x) * row.halfSize.y;
  return bySpacing > 0.0 ? bySpacing : std::max(byBox, 1e-12);
}
} // namespace

std::unique_ptr<HeadItem> HeadItem::leafOf(std::uint32_t tile, std::uint32_t root, const Node& row)
{
  auto item = std::make_unique<HeadItem>();
  item->leaf = true;
  item->tile = tile;
  item->root = root;
  item->spacing = row.spacing;
  item->splatRadius = row.splatRadius;
  item->box = row.box();
  item->area = rootArea(row);
  return item;
}

void HeadItem::addUp()
{
  box = Bounds();
  area = 0.0;
  for (const auto& child : children)
  {
    box.add(child->box);
    area += child->area;
  }
}

std::unique_ptr<HeadItem> HeadTree::grouped(std::vector<TileHead*> heads) const
{
  std::unique_ptr<HeadItem> group = emptyGroup();
  const bool ofRoots = heads.size() <= rootsOfGroup;
  deal(*group, heads, ofRoots ? 0 : groupPoints);
  if (ofRoots)
  {
    for (TileHead* const head : heads)
    {
      group->children.push_back(std::move(head->leaf));
    }
    group->addUp();
    return group;
  }
  const auto itemOf = [](const TileHead* head) -> const HeadItem& { return *head->leaf; };
  std::vector<std::vector<TileHead*>> parts;
  parts.push_back(std::move(heads));
  for (std::size_t count = 1; count < groupsOfGroup; count *= 2)
  {
    for (std::size_t p = 0; p < count && p < parts.size(); ++p)
    {
      if (parts[p].size() > 1)
      {
        std::vector<TileHead*> behind = halved(parts[p], itemOf);
        parts.push_back(std::move(behind));
      }
    }
  }
  for (std::vector<TileHead*>& part : parts)
  {
    group->children.push_back(grouped(std::move(part)));
  }
  group->addUp();
  return group;
}

void HeadTree::build(std::vector<TileHead> heads)
{
  std::vector<TileHead*> all;
  for (TileHead& head : heads)
  {
    all.push_back(&head);
  }
  root_ = grouped(std::move(all));
}

Result<void> HeadTree::load(HeadItem& group) const
{
  if (group.points)
  {
    return {};
  }
  Result<HeadPoints> points = load_(group);
  if (!points)
  {
    return points.error();
  }
  group.points = std::make_unique<HeadPoints>(std::move(*points));
  return {};
}

Result<void> HeadTree::loadBelow(HeadItem& group) const
{
  Result<void> done = group.leaf ? Result<void>() : load(group);
  for (std::size_t c = 0; c < group.children.size() && done; ++c)
  {
    done = loadBelow(*group.children[c]);
  }
  return done;
}

Result<void> HeadTree::loadAll()
{
  return root_ ? loadBelow(*root_) : Result<void>();
}

Result<void> HeadTree::insert(TileHead head)
{
  if (!root_)
  {
    std::vector<TileHead> one;
    one.push_back(std::move(head));
    build(std::move(one));
    return {};
  }
  const glm::dvec3 place = head.leaf->box.centre();
  std::vector<HeadItem*> path{ root_.get() };
  while (!path.back()->children.front()->leaf)
  {
    path.push_back(&nearestChild(*path.back(), place));
  }
  for (std::size_t depth = 0; depth < path.size(); ++depth)
  {
    HeadItem& group = *path[depth];
    if (Result<void> loaded = load(group); !loaded)
    {
      return loaded;
    }
    const std::size_t left = head.points.size() - head.taken;
    const double share = groupPoints * head.leaf->area / (group.area + head.leaf->area) +
      fractionOf(head.leaf->tile, depth);
    const std::size_t count =
      depth + 1 == path.size() ? left : std::min(left, static_cast<std::size_t>(share));
    group.points->append(head.points, head.taken, head.taken + count);
    head.taken += count;
  }
  path.back()->children.push_back(std::move(head.leaf));
  for (std::size_t depth = path.size(); depth-- > 0;)
  {
    HeadItem& group = *path[depth];
    group.addUp();
    if (group.children.size() <= mostChildren)
    {
      continue;
    }
    if (depth == 0)
    {
      return splitRoot();
    }
    Result<std::unique_ptr<HeadItem>> other = splitOff(group);
    if (!other)
    {
      return other.error();
    }
    path[depth - 1]->children.push_back(std::move(*other));
  }
  return {};
}

/// Takes half of a group's children, and their points, into a new one.
Result<std::unique_ptr<HeadItem>> HeadTree::splitOff(HeadItem& group) const
{
  if (Result<void> loaded = load(group); !loaded)
  {
    return loaded.error();
  }
  std::unique_ptr<HeadItem> other = emptyGroup();
  other->children = halved(group.children,
    [](const std::unique_ptr<HeadItem>& child) -> const HeadItem& { return *child; });
  std::unordered_set<std::uint32_t> theirs;
  collectTiles(*other, theirs);
  *other->points = group.points->ofTiles(theirs, false);
  *group.points = group.points->ofTiles(theirs, true);
  group.addUp();
  other->addUp();
  return other;
}

/// A root of two halves, which has the first of their points.
Result<void> HeadTree::splitRoot()
{
  Result<std::unique_ptr<HeadItem>> other = splitOff(*root_);
  if (!other)
  {
    return other.error();
  }
  std::unique_ptr<HeadItem> root = emptyGroup();
  root->children.push_back(std::move(root_));
  root->children.push_back(std::move(*other));
  root->addUp();
  for (const auto& half : root->children)
  {
    const auto share = static_cast<std::size_t>(groupPoints * half->area / root->area);
    const std::size_t count = std::min(share, half->points->size());
    root->points->append(*half->points, 0, count);
    *half->points = half->points->behind(count);
  }
  root_ = std::move(root);
  return {};
}

/// Whether something below was taken out.
Result<bool> HeadTree::removeBelow(
  HeadItem& group, const std::unordered_set<std::uint32_t>& tiles) const
{
  bool touched = false;
  for (std::size_t c = 0; c < group.children.size();)
  {
    HeadItem& child = *group.children[c];
    bool gone = child.leaf && tiles.count(child.tile) > 0;
    if (!child.leaf)
    {
      const Result<bool> below = removeBelow(child, tiles);
      if (!below)
      {
        return below;
      }
      gone = child.children.empty();
      touched = touched || *below;
    }
    touched = touched || gone;
    if (gone)
    {
      group.children.erase(group.children.begin() + static_cast<std::ptrdiff_t>(c));
    }
    else
    {
      ++c;
    }
  }
  if (touched && !group.children.empty())
  {
    if (Result<void> loaded = load(group); !loaded)
    {
      return loaded.error();
    }
    *group.points = group.points->ofTiles(tiles, true);
    group.addUp();
  }
  return touched;
}

Result<void> HeadTree::remove(const std::unordered_set<std::uint32_t>& tiles)
{
  const Result<bool> touched = root_ ? removeBelow(*root_, tiles) : Result<bool>(false);
  if (!touched)
  {
    return touched.error();
  }
  if (root_ && root_->children.empty())
  {
    root_.reset();
  }
  return {};
}

} // namespace pointfront
