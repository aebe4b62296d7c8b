#pragma once

#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Front/NodeSlots.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace pointfront
{

using SlotIndex = std::uint32_t;
constexpr SlotIndex noSlot = 0xffffffffu;

/// A node of the front or above it: its row, copied when it became active (a paged table is not
/// touched again), and how the current view sees it.
struct ActiveNode
{
  glm::dvec3 centre{ 0.0 };
  float radius = 0.0f;
  float spacing = 0.0f; ///< > 0: half the parent's where the table has none
  float spacingRatio = 0.0f; ///< to the parent's spacing; 0 for a root
  std::uint32_t storedPoints = 0; ///< in the table
  std::uint32_t pointCount = 0; ///< its points, 0 where none would be drawn (NodePruning)
  NodeIndex node = noNode; ///< noNode: the slot is free
  NodeIndex firstChild = noNode;
  SlotIndex parent = noSlot;
  SlotIndex children = noSlot; ///< first of childCount neighbouring slots; noSlot: on the front
  std::uint8_t childCount = 0; ///< in the table
  std::uint8_t level = 0;
  std::uint16_t layer = 0;
  bool hidden = false; ///< its layer is, or no point of its subtree would be drawn
  float errorWeight = 1.0f; ///< LAYERS-11: 1 / the layer's errorFactor

  bool lost = false; ///< its row cannot be read: a leaf without points in its parent's place
  bool visible = false;
  float errorPx = 0.0f; ///< projected spacing * errorWeight
  float distance = 0.0f;

  // Numbers of the update in which it last was ...
  std::uint32_t created = 0;
  std::uint32_t evaluated = 0; ///< visible, errorPx and distance are of the current view
  std::uint32_t live = 0; ///< reached from a root through visible nodes above the threshold
  std::uint32_t seen = 0; ///< live and visible
  std::uint32_t needed = 0; ///< drawn, or waited for

  bool leaf() const { return childCount == 0; }
  bool expanded() const { return children != noSlot; }
};

/// The part of a hierarchy at and above the rendering front (FRONT-5). Its leaves are the front:
/// they are a cut of the whole hierarchy by construction, since a node has all of its children
/// here or none.
/// Size     proportional to the active nodes, whatever the size of the table. Slots are used again:
///          in the steady state nothing is allocated.
/// Threads  one.
class ActiveTree
{
public:
  explicit ActiveTree(const Hierarchy& hierarchy);

  /// Back to the roots.
  void reset();

  /// LAYERS-11: sets the limits of the layers; layers beyond the list have default limits. Time
  /// linear in the slots when something changes.
  void setLayers(const std::vector<LayerLimits>& layers);

  Refinement refinement() const { return hierarchy_.refinement(); }

  /// Slots 0 to rootCount() - 1 are the roots, in the order of Hierarchy::roots().
  SlotIndex rootCount() const { return rootCount_; }
  /// Free slots among them: node == noNode.
  SlotIndex slotCount() const { return static_cast<SlotIndex>(slots_.size()); }
  ActiveNode& operator[](SlotIndex slot) { return slots_[slot]; }
  const ActiveNode& operator[](SlotIndex slot) const { return slots_[slot]; }
  std::uint32_t frontLength() const { return frontLength_; }

  /// Replaces a front node by its children. References into the tree become invalid. False, and
  /// nothing is done, while a row of them is coming from a paged table.
  bool expand(SlotIndex slot, std::uint32_t update);
  /// Replaces children that all are on the front by their parent.
  void collapse(SlotIndex slot);

  /// The slot of the node's nearest active ancestor (or its own) and how many levels that lies
  /// above it; noSlot when that cannot be told without waiting for the table.
  struct Nearest
  {
    SlotIndex slot = noSlot;
    std::uint32_t levelsAbove = 0;
  };
  Nearest find(NodeIndex node) const;

  /// Sets visibility, error and distance of a node, of this tree or of childOf(), for a view.
  void evaluate(ActiveNode& node, const View& view, std::uint32_t update) const;

  /// Reads the row of child number `child` of a node; false while the row is coming.
  bool childOf(const ActiveNode& parent, std::uint8_t child, ActiveNode& node) const;

private:
  SlotIndex takeBlock(std::uint8_t length);

  void applyLayer(ActiveNode& node) const;

  const Hierarchy& hierarchy_;
  std::vector<LayerLimits> layers_;
  std::vector<ActiveNode> slots_;
  NodeSlots slotOf_;
  std::vector<ActiveNode> children_; ///< scratch of expand()
  std::array<std::vector<SlotIndex>, 256> freeBlocks_; ///< by length
  SlotIndex rootCount_ = 0;
  std::uint32_t frontLength_ = 0;
};

} // namespace pointfront
