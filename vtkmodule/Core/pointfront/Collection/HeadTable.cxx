#include "pointfront/Collection/HeadTable.h"

#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Trees/BuiltTree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace pointfront
{
namespace
{
/// The points of a group as they lie in the state before.
Result<EncodedNode> storedNode(const HeadItem& group, const PointStore& before)
{
  Result<EncodedNode> stored = before.encodedNode(group.stored);
  if (stored)
  {
    stored->bounds = group.facts.bounds;
    stored->ranges = group.facts.ranges;
  }
  return stored;
}
} // namespace

HeadTable::HeadTable(const std::vector<const HeadItem*>& roots)
{
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
    row.spacing = item.row.spacing;
    row.splatRadius = item.row.splatRadius;
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

Result<void> HeadTable::append(StoreWriter& writer, const AttributeSchema& schema,
  const PointStore* before, const std::string& path)
{
  const std::size_t count = items_.size();
  std::vector<std::optional<EncodedNode>> encoded(count);
  std::vector<std::optional<Error>> faults(count);
  ThreadCrew::ofProcess().run(count,
    [&](std::size_t i, unsigned)
    {
      const HeadItem& item = *items_[i];
      if (item.leaf || !item.points)
      {
        return;
      }
      NodeColumns node;
      if (item.points->asNode(schema, node))
      {
        encoded[i] = encodeNode(node, schema);
        return;
      }
      faults[i] = makeError(Error::Kind::Unsupported,
        path +
          ": its tiles lie farther apart than 32 bits of steps of the finest grid; build "
          "them with a coarser --precision");
    });
  NodeColumns none;
  HeadPoints().asNode(schema, none);
  const EncodedNode nothing = encodeNode(none, schema);
  for (std::size_t i = 0; i < count; ++i)
  {
    const HeadItem& item = *items_[i];
    if (faults[i])
    {
      return *faults[i];
    }
    if (!item.leaf && !encoded[i])
    {
      Result<EncodedNode> stored = storedNode(item, *before);
      if (!stored)
      {
        return stored.error();
      }
      encoded[i] = std::move(*stored);
    }
    const EncodedNode& payload = item.leaf ? nothing : *encoded[i];
    const Result<StoreWriter::PayloadId> id = writer.append(payload);
    if (!id)
    {
      return id.error();
    }
    payloads_.push_back(*id);
    facts_.push_back(item.leaf ? HeadNode() : HeadNode{ {}, payload.bounds, payload.ranges });
    encoded[i].reset();
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

std::vector<HeadNode> HeadTable::facts(const std::vector<CollectedTile>& tiles) const
{
  std::unordered_map<std::uint32_t, std::uint32_t> places;
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    places[tiles[t].is.id] = static_cast<std::uint32_t>(t);
  }
  std::vector<HeadNode> all = facts_;
  for (std::size_t i = 0; i < items_.size(); ++i)
  {
    if (items_[i]->leaf)
    {
      all[i] = { std::pair(places[items_[i]->tile], items_[i]->root), {}, {} };
    }
  }
  return all;
}

} // namespace pointfront
