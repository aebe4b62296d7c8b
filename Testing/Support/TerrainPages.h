#pragma once

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Store/NodePage.h"
#include "pointfront/Store/PagedNodeTable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront::test
{

/// The node table of a made-up terrain: a complete quadtree, breadth first, of any size. A row is a
/// function of its number; nothing of it is in memory. For tests and benchmarks of tables larger
/// than memory: 14 levels are 89,478,485 nodes and, at 10,000 points a node, 9 * 10^11 points.
class Terrain
{
public:
  static constexpr double sizeMetres = 1e5;
  static constexpr std::uint32_t pointsOfNode = 10000;

  explicit Terrain(int levels)
  {
    for (int level = 0; level < levels; ++level)
    {
      firstOf_.push_back(count_);
      count_ += NodeIndex(1) << (2 * level);
    }
  }

  NodeIndex nodeCount() const { return count_; }

  Node row(NodeIndex index) const
  {
    const auto above = std::upper_bound(firstOf_.begin(), firstOf_.end(), index);
    const auto level = static_cast<std::uint8_t>(above - firstOf_.begin() - 1);
    const NodeIndex place = index - firstOf_[level];
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    for (int bit = 0; bit < level; ++bit)
    {
      x |= (place >> (2 * bit) & 1u) << bit;
      y |= (place >> (2 * bit + 1) & 1u) << bit;
    }
    const double size = sizeMetres / double(NodeIndex(1) << level);
    Node node;
    node.centre = { (x + 0.5) * size, (y + 0.5) * size, 0.0 };
    node.halfSize = glm::vec3(float(0.5 * size), float(0.5 * size), float(0.05 * size));
    node.radius = float(0.71 * size);
    node.spacing = float(size / 100.0);
    node.splatRadius = 0.8f * node.spacing;
    node.pointCount = pointsOfNode;
    node.firstPoint = std::uint64_t(index) * pointsOfNode;
    node.level = level;
    node.parent = level == 0 ? noNode : firstOf_[level - 1u] + place / 4;
    const auto below = static_cast<std::uint32_t>(firstOf_.size()) - level;
    node.pointsBelow = pointsOfNode * (((std::uint64_t(1) << (2 * below)) - 1) / 3);
    if (std::size_t(level) + 1 < firstOf_.size())
    {
      node.childCount = 4;
      node.firstChild = firstOf_[level + 1u] + place * 4;
    }
    return node;
  }

private:
  std::vector<NodeIndex> firstOf_;
  NodeIndex count_ = 0;
};

/// Its pages: made, encoded, and then checked and decoded as those of a file are.
class TerrainPages final : public NodePageSource
{
public:
  explicit TerrainPages(int levels)
    : terrain_(levels)
  {
  }
  NodeIndex nodeCount() const override { return terrain_.nodeCount(); }
  Result<void> read(std::uint32_t page, NodePage& rows) const override
  {
    const TableLimits limits{ nodeCount(), 1 };
    NodePage made;
    for (std::uint32_t r = 0; r < nodePageLength(nodeCount(), page); ++r)
    {
      made[r] = terrain_.row(page * nodePageRows + r);
    }
    std::array<std::byte, nodePageBytes> bytes;
    encodeNodePage(made.data(), nodePageLength(nodeCount(), page), page, bytes.data());
    const std::string fault = decodeNodePage(bytes.data(), page, limits, rows);
    return fault.empty() ? Result<void>() : makeError(Error::Kind::Corrupt, fault);
  }

private:
  Terrain terrain_;
};

inline std::shared_ptr<PagedNodeTable> terrainTable(
  int levels, std::size_t cacheBytes = PagedNodeTable::defaultCacheBytes)
{
  return std::make_shared<PagedNodeTable>(std::make_unique<TerrainPages>(levels),
    std::vector<NodeIndex>{ 0 }, Refinement::Add, cacheBytes);
}

} // namespace pointfront::test
