#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Error.h"
#include "pointfront/Store/MissingRows.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pointfront
{

using NodeIndex = std::uint32_t;
constexpr NodeIndex noNode = 0xffffffffu;

/// One node of a hierarchy: everything that the front may know about it. A node is a chunk of some
/// ten thousand points, not a single point.
/// Units  world units of the store's CRS (metres unless it says otherwise).
struct Node
{
  glm::dvec3 centre{ 0.0 }; ///< centre of the box, world
  glm::vec3 halfSize{ 0.0f }; ///< half of the box of this node's points and all below; rounded up
  float radius = 0.0f; ///< radius of the sphere around `centre` with all those points; rounded up
  float spacing = 0.0f; ///< between points when this node and all above it are drawn
  /// Radius of the discs that close the surface when all points of this node and of the nodes above
  /// it are drawn; 0 if it was not measured.
  float splatRadius = 0.0f;
  std::uint32_t pointCount = 0; ///< the node's own points; may be 0 for an inner node
  /// Points of the input in this node and all its descendants: representatives do not count.
  std::uint64_t pointsBelow = 0;
  /// Number of own points of all nodes before it in the table: the number of its first point in the
  /// store.
  std::uint64_t firstPoint = 0;
  NodeIndex parent = noNode;
  NodeIndex firstChild = noNode; ///< children are neighbours in the table
  std::uint8_t childCount = 0;
  std::uint8_t level = 0; ///< roots are 0
  std::uint16_t layer = 0; ///< index into the store's layers

  bool leaf() const { return childCount == 0; }
  Bounds box() const
  {
    return Bounds{ centre - glm::dvec3(halfSize), centre + glm::dvec3(halfSize) };
  }
};

/// How the points of a deeper node relate to the points above it.
enum class Refinement : std::uint8_t
{
  Add = 1, ///< inner nodes hold a subset; every point is stored once; ancestors stay drawn
  Replace = 2 ///< inner nodes hold mean representatives; children replace their parent
};

/// How many of a node's points are points of the input: with Replace none but those of leaves.
inline std::uint32_t originalPoints(const Node& node, Refinement refinement)
{
  return refinement == Refinement::Add || node.leaf() ? node.pointCount : 0u;
}

/// The answer of a table about a node's row without waiting.
enum class RowState : std::uint8_t
{
  Here, ///< in memory
  Coming, ///< not in memory, asked for (MissingRows): Hierarchy::arrivals() will change
  Lost ///< cannot be read, or is damaged
};

/// The node table of one store: the shape of the hierarchy without any payload.
/// Several roots when the store has layers. Virtual, because a table of 10^8 nodes is paged.
/// Damage   of a paged table is found when a page is read. Such a row comes back hollow: no points,
///          no children, no parent; and fault() is set. Who walks a table for a result that
///          must be whole asks fault() at the end.
/// Threads  const functions are safe from any thread.
class Hierarchy
{
public:
  virtual ~Hierarchy() = default;
  virtual NodeIndex nodeCount() const = 0;
  /// May wait for the disk.
  virtual Node node(NodeIndex index) const = 0;
  virtual const std::vector<NodeIndex>& roots() const = 0;
  virtual Refinement refinement() const = 0;

  /// Child number `child` of a node; hollow unless the child's row names this parent, so that a
  /// walk down meets each node once whatever the bytes say. May wait for the disk.
  virtual Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
  {
    static_cast<void>(parent);
    return node(row.firstChild + child);
  }
  /// Numbers of a node's children, appended to `target`; those whose rows are lost are left out.
  void appendChildren(NodeIndex parent, const Node& row, std::vector<NodeIndex>& target) const
  {
    for (std::uint32_t c = 0; c < row.childCount; ++c)
    {
      if (childOf(parent, row, static_cast<std::uint8_t>(c)).parent == parent)
      {
        target.push_back(row.firstChild + c);
      }
    }
  }
  /// For a thread that must not wait: fills `row` if the row is in memory.
  virtual RowState peek(NodeIndex index, Node& row) const
  {
    row = node(index);
    return RowState::Here;
  }
  /// The same for a child: Lost unless the child's row names this parent.
  virtual RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
  {
    found = childOf(parent, row, child);
    return RowState::Here;
  }
  /// Some nodes, from the first to before the second, among which is the last whose first point is
  /// `point` or one before it: all, or fewer where rows of others are better left alone.
  virtual std::pair<NodeIndex, NodeIndex> nodesAround(std::uint64_t point) const
  {
    static_cast<void>(point);
    return { 0, nodeCount() };
  }
  /// The rows that peek() was asked for and that are not in memory.
  virtual MissingRows* missingRows() const { return nullptr; }
  /// Grows when rows that were coming are here, or lost.
  virtual std::uint64_t arrivals() const { return 0; }
  /// Blocks until arrivals() differs from `seen` or no row is coming. Reads the coming rows itself
  /// if nobody else does (MissingRows).
  /// Not longer than to `end`, but for a read of its own. False: nothing is coming.
  virtual bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const
  {
    static_cast<void>(seen);
    static_cast<void>(end);
    return false;
  }
  /// The same, without an end.
  void waitForArrival(std::uint64_t seen) const
  {
    while (arrivals() == seen &&
      waitForArrival(seen, std::chrono::steady_clock::now() + std::chrono::seconds(1)))
    {
    }
  }
  /// The first damage that was met.
  virtual std::optional<Error> fault() const { return std::nullopt; }
  /// Damage met since the last call, each page once.
  virtual std::vector<Error> takeFaults() const { return {}; }
};

/// The plain table in memory.
class HierarchyTable final : public Hierarchy
{
public:
  /// Sets firstPoint of the nodes.
  HierarchyTable(std::vector<Node> nodes, std::vector<NodeIndex> roots, Refinement refinement)
    : nodes_(std::move(nodes))
    , roots_(std::move(roots))
    , refinement_(refinement)
  {
    std::uint64_t number = 0;
    for (Node& node : nodes_)
    {
      node.firstPoint = number;
      number += node.pointCount;
    }
  }
  NodeIndex nodeCount() const override { return static_cast<NodeIndex>(nodes_.size()); }
  Node node(NodeIndex index) const override { return nodes_[index]; }
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return refinement_; }

private:
  std::vector<Node> nodes_;
  std::vector<NodeIndex> roots_;
  Refinement refinement_;
};

} // namespace pointfront
