#include "pointfront/Collection/HeadTable.h"

#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Trees/BuiltTree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace pointfront
{
namespace
{
/// Items of a tree.
std::size_t itemsOf(const HeadItem& item)
{
  return std::accumulate(item.children.begin(), item.children.end(), std::size_t(1),
    [](std::size_t sum, const auto& child) { return sum + itemsOf(*child); });
}
} // namespace

HeadTable::HeadTable(const std::vector<const HeadItem*>& roots)
{
  const std::size_t count = std::accumulate(roots.begin(), roots.end(), std::size_t(0),
    [](std::size_t sum, const HeadItem* root) { return sum + itemsOf(*root); });
  items_.reserve(count);
  rows_.reserve(count);
  for (std::size_t r = 0; r < roots.size(); ++r)
  {
    Node row;
    row.layer = static_cast<std::uint16_t>(r);
    roots_.push_back(static_cast<NodeIndex>(r));
    items_.push_back(roots[r]);
    rows_.push_back(row);
  }
  for (std::size_t i = 0; i < items_.size(); ++i) // breadth first
  {
    const HeadItem& item = *items_[i];
    rows_[i].pointCount = item.leaf ? 0 : item.pointCount();
    rows_[i].childCount = static_cast<std::uint8_t>(item.children.size());
    rows_[i].firstChild = item.children.empty() ? noNode : static_cast<NodeIndex>(items_.size());
    encloseBox(rows_[i], item.box);
    for (const auto& child : item.children)
    {
      Node row;
      row.parent = static_cast<NodeIndex>(i);
      row.level = static_cast<std::uint8_t>(rows_[i].level + 1);
      row.layer = rows_[i].layer;
      items_.push_back(child.get());
      rows_.push_back(row);
    }
  }
  for (const NodeIndex root : roots_)
  {
    describeRow(root, 1.0, 0.0);
  }
}

/// Points on an area: those of this node, and of the nodes above as many as lie on its area. The
/// spacing follows from their density; so does the radius, which closes what the spacing leaves.
void HeadTable::describeRow(NodeIndex node, double areaAbove, double pointsAbove)
{
  const HeadItem& item = *items_[node];
  Node& row = rows_[node];
  if (item.leaf)
  {
    row.spacing = item.spacing;
    row.splatRadius = item.splatRadius;
    return;
  }
  const double inherited = pointsAbove * std::min(1.0, item.area / areaAbove);
  const double points = std::max(1.0, inherited + row.pointCount);
  row.spacing = static_cast<float>(std::sqrt(item.area / points));
  row.pointsBelow = row.pointCount;
  for (std::uint32_t c = 0; c < row.childCount; ++c)
  {
    const NodeIndex child = row.firstChild + c;
    describeRow(child, item.area, inherited + row.pointCount);
    const Node& below = rows_[child];
    row.pointsBelow += below.pointsBelow;
    row.spacing = std::max(row.spacing, below.spacing);
    // As many times wider as its points lie apart.
    const float wider = below.spacing > 0.0f ? row.spacing / below.spacing : 1.0f;
    row.splatRadius = std::max(row.splatRadius, below.splatRadius * wider);
  }
}

/// The points of a group as they lie in the state before.
Result<StoreWriter::PayloadId> HeadTable::appendStored(
  StoreWriter& writer, const HeadItem& group, PayloadCopy& copy, HeadNode& facts)
{
  const Result<StoredPayload> payload = copy.of(group.stored, group.storedPoints);
  if (!payload)
  {
    return payload.error();
  }
  facts_.push_back(std::move(facts));
  return writer.append(*payload, facts_.back().bounds, facts_.back().ranges);
}

/// Codes the points of groups that changed, in the order of the items.
Result<std::vector<EncodedNode>> HeadTable::encodeChanged(
  const AttributeSchema& schema, const std::string& path) const
{
  std::vector<const HeadPoints*> changed;
  for (const HeadItem* const item : items_)
  {
    if (item->points)
    {
      changed.push_back(item->points.get());
    }
  }
  std::vector<EncodedNode> encoded(changed.size());
  std::vector<char> fits(changed.size(), 1);
  ThreadCrew::ofProcess().run(changed.size(),
    [&](std::size_t i, unsigned)
    {
      NodeColumns node;
      fits[i] = changed[i]->asNode(schema, node) ? 1 : 0;
      if (fits[i] != 0)
      {
        encoded[i] = encodeNode(node, schema);
      }
    });
  if (std::find(fits.begin(), fits.end(), 0) != fits.end())
  {
    return makeError(Error::Kind::Unsupported,
      path +
        ": its tiles lie farther apart than 32 bits of steps of the finest grid; build "
        "them with a coarser --precision");
  }
  return encoded;
}

Result<void> HeadTable::append(
  StoreWriter& writer, const AttributeSchema& schema, StoredHeads before, const std::string& path)
{
  Result<std::vector<EncodedNode>> encoded = encodeChanged(schema, path);
  if (!encoded)
  {
    return encoded.error();
  }
  std::optional<PayloadCopy> copy;
  if (before.store != nullptr)
  {
    copy.emplace(*before.store);
  }
  NodeColumns none;
  HeadPoints().asNode(schema, none);
  std::optional<StoreWriter::PayloadId> nothing; // all leaves have it
  auto next = encoded->begin();
  payloads_.reserve(items_.size());
  facts_.reserve(items_.size());
  for (const HeadItem* const item : items_)
  {
    const Result<StoreWriter::PayloadId> id = item->leaf && nothing ? *nothing
      : item->leaf   ? writer.append(encodeNode(none, schema))
      : item->points ? writer.append(*next)
                     : appendStored(writer, *item, *copy, before.facts[item->stored]);
    if (!id)
    {
      return id.error();
    }
    payloads_.push_back(*id);
    if (item->leaf)
    {
      nothing = *id;
      facts_.emplace_back();
    }
    else if (item->points)
    {
      facts_.push_back({ {}, next->bounds, std::move(next->ranges) });
      *next++ = EncodedNode();
    }
  }
  return {};
}

std::uint64_t HeadTable::points() const
{
  std::uint64_t sum = 0;
  for (const Node& row : rows_)
  {
    sum += row.pointCount;
  }
  return sum;
}

std::vector<HeadNode> HeadTable::takeFacts(const std::vector<CollectedTile>& tiles)
{
  std::unordered_map<std::uint32_t, std::uint32_t> places;
  places.reserve(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    places[tiles[t].is.id] = static_cast<std::uint32_t>(t);
  }
  for (std::size_t i = 0; i < items_.size(); ++i)
  {
    if (items_[i]->leaf)
    {
      facts_[i].root = std::pair(places[items_[i]->tile], items_[i]->root);
    }
  }
  return std::move(facts_);
}

} // namespace pointfront
