#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Collection/HeadPoints.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Tiles/CollectionRecord.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_set>
#include <vector>

namespace pointfront
{

/// A node of the tree of heads while a collection is written: a group of tiles with some of their
/// first points, or one root of a tile.
struct HeadItem
{
  bool leaf = false;
  std::uint32_t tile = 0; ///< a leaf's: id of the tile
  std::uint32_t root = 0; ///< and which of its roots
  float spacing = 0.0f; ///< that root's
  float splatRadius = 0.0f;

  std::vector<std::unique_ptr<HeadItem>> children; ///< a group's
  NodeIndex stored = noNode; ///< node of the state before that has the group's points
  std::uint32_t storedPoints = 0;
  std::unique_ptr<HeadPoints> points; ///< where they are no longer the stored ones

  Bounds box; ///< box of all points below
  double area = 0.0; ///< sum of spacing squared times points, over the roots below

  std::uint32_t pointCount() const
  {
    return points ? static_cast<std::uint32_t>(points->size()) : storedPoints;
  }
  void addUp(); ///< box and area of a group, from its children

  /// A leaf; `row` is that of the root in its tile.
  static std::unique_ptr<HeadItem> leafOf(std::uint32_t tile, std::uint32_t root, const Node& row);
};

/// One root of a tile and its first points, which a tree of heads takes.
struct TileHead
{
  std::unique_ptr<HeadItem> leaf;
  HeadPoints points;
  std::size_t taken = 0;
};

/// The tree of heads of one layer: an R-tree of the tiles' roots. Each group holds points of all
/// tiles below it, as many of each as suit its area: `groupPoints` together; groups of roots hold
/// all that is left of the heads.
/// Cost    to add or remove a root: the groups above it, each read and coded anew.
/// Source  Guttman 1984 (R-trees), with the nearest box instead of the least enlarged one.
class HeadTree
{
public:
  static constexpr std::uint32_t groupPoints = 1u << 14;
  static constexpr std::size_t rootsOfGroup = 16;
  static constexpr std::size_t groupsOfGroup = 8;
  static constexpr std::size_t mostChildren = 32; ///< a group that has more is split

  /// Reads the stored points of a group.
  using Load = std::function<Result<HeadPoints>(const HeadItem&)>;

  explicit HeadTree(Load load)
    : load_(std::move(load))
  {
  }
  /// A tree that is there already.
  HeadTree(std::unique_ptr<HeadItem> root, Load load)
    : root_(std::move(root))
    , load_(std::move(load))
  {
  }

  /// Makes the tree of all heads anew.
  void build(std::vector<TileHead> heads);
  Result<void> insert(TileHead head);
  /// Takes tiles out. The tree may be empty then.
  Result<void> remove(const std::unordered_set<std::uint32_t>& tiles);

  const HeadItem* root() const { return root_.get(); }
  HeadItem* root() { return root_.get(); }
  /// Reads the points of all groups that are only stored.
  Result<void> loadAll();

private:
  std::unique_ptr<HeadItem> grouped(std::vector<TileHead*> heads) const;
  Result<void> load(HeadItem& group) const;
  Result<void> loadBelow(HeadItem& group) const;
  Result<bool> removeBelow(HeadItem& group, const std::unordered_set<std::uint32_t>& tiles) const;
  Result<std::unique_ptr<HeadItem>> splitOff(HeadItem& group) const;
  Result<void> splitRoot();

  std::unique_ptr<HeadItem> root_;
  Load load_;
};

} // namespace pointfront
