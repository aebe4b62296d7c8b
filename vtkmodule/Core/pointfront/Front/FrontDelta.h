#pragma once

#include "pointfront/Front/DemandCurve.h"
#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Which nodes of a store are in memory at this moment. A snapshot for the length of one update.
class ResidencySnapshot
{
public:
  enum class State : std::uint8_t
  {
    Absent,
    Resident,
    Failed ///< could not be read; is not asked for again
  };
  virtual ~ResidencySnapshot() = default;
  virtual State state(NodeIndex node) const = 0;
  /// Changes whenever the state of any node changes, so that an update in which nothing changed can
  /// end at once. 0: not known; every update then asks anew.
  virtual std::uint64_t revision() const { return 0; }
  /// True when nothing more can come: the memory is full of what the front needs, and no
  /// request that waits fits. The view is then as complete as this memory allows.
  virtual bool exhausted() const { return false; }
};

/// A limit that a front shares with others (SharedDemand.h), in points of this store or in slots of
/// GPU memory.
struct SharedLimit
{
  std::uint64_t most = 0; ///< the limit of all together; 0: no limit
  /// The demand of the others; step 0 is the amount that they have at this moment. Not null where
  /// there is a limit, and alive while the limits are in use.
  const DemandCurve* elsewhere = nullptr;

  std::uint64_t leftAt(double px) const
  {
    const std::uint64_t others = elsewhere->at(px);
    return most > others ? most - others : 0;
  }
};

/// The limits and the goal of one update.
struct FrontLimits
{
  double targetErrorPx = 1.0; ///< the threshold stops falling here
  double initialErrorPx = 60.0; ///< FRONT-7: where it starts
  /// FRONT-6: most expansions + collapses; the next frame continues with the rest.
  std::uint32_t movesPerFrame = 64;
  std::uint64_t pointBudget = 0; ///< FRONT-8: most points drawn; 0: no limit
  /// Most points in the nodes that the view needs in memory, drawn or not (a node is held whole
  /// although a prefix of it may be drawn); 0: no limit. Budget bytes / bytes of a decoded point,
  /// with some room to spare, makes a view that needs more settle at the best error that fits.
  std::uint64_t heldPointBudget = 0;
  SharedLimit sharedDrawn; ///< as pointBudget, over all clouds of a window
  SharedLimit sharedSlots; ///< slots of GPU memory (GpuSlots.h), over all clouds of a window
  SharedLimit sharedHeld; ///< as heldPointBudget, over all stores of a process
  /// Changes whenever one of the curves of the shared limits does.
  std::uint64_t sharedRevision = 0;
  std::uint32_t requestLimit = 256; ///< most requests handed out by one update
  bool interacting = false; ///< in motion the threshold does not fall below motionErrorPx
  double motionErrorPx = 0.0; ///< FRONT-7: raised by the caller until the frame rate holds
  /// SMOOTH-2, ViewDetail only: points of this store that are in memory and drawn for every view:
  /// its share of the scene's overview (overviewShare()).
  std::uint64_t overviewPoints = 2000000;
  /// FRONT-9: also ask for siblings of requested nodes that are out of sight, after all nodes in
  /// sight and only into free memory. Off for a single still picture.
  bool prefetchSiblings = true;
  /// LAYERS-11: by number of the layer; layers beyond the list are as by default.
  std::vector<LayerLimits> layers;
};

/// The curves of the others are not compared: sharedRevision changes with them.
inline bool operator==(const FrontLimits& a, const FrontLimits& b)
{
  return a.targetErrorPx == b.targetErrorPx && a.initialErrorPx == b.initialErrorPx &&
    a.movesPerFrame == b.movesPerFrame && a.pointBudget == b.pointBudget &&
    a.heldPointBudget == b.heldPointBudget && a.requestLimit == b.requestLimit &&
    a.interacting == b.interacting && a.motionErrorPx == b.motionErrorPx &&
    a.prefetchSiblings == b.prefetchSiblings && a.overviewPoints == b.overviewPoints &&
    a.layers == b.layers && a.sharedDrawn.most == b.sharedDrawn.most &&
    a.sharedSlots.most == b.sharedSlots.most && a.sharedHeld.most == b.sharedHeld.most;
}

struct DrawItem
{
  NodeIndex node = noNode;
  std::uint32_t pointCount = 0; ///< a prefix of the node's points (PointPrefix.h), at least 1
  float errorPx = 0.0f; ///< projected spacing of this node, whatever its layer's factor
  float distance = 0.0f; ///< from the eye to its sphere
  float spacingRatio = 0.0f; ///< its spacing to its parent's (PointPrefix.h); 0 for a root
};

struct LoadRequest
{
  NodeIndex node = noNode;
  double priority = 0.0; ///< larger is sooner; the error on screen that it would mend, in px
  bool optional = false; ///< not needed for this view: after all others, into free memory only
  /// All points of the node: the loader must know the memory that it needs without reading the
  /// table.
  std::uint32_t pointCount = 0;
  std::uint16_t layer = 0; ///< likewise: which columns it is wanted with
};

/// The decisions of one update. Owned by the front, valid until its next update.
struct FrontDelta
{
  /// The number of the update that made it, from 1 on. The same number again means that nothing has
  /// changed.
  std::uint64_t number = 0;
  std::vector<DrawItem> draw; ///< near to far, ties by node: two runs give the same list
  /// All nodes that are wanted now: optional ones last, highest priority first, ties by node.
  std::vector<LoadRequest> requests;
  std::uint64_t pointsDrawn = 0;
  std::uint64_t slotsDrawn = 0; ///< slots of GPU memory (GpuSlots.h) that they take
  std::uint32_t moves = 0; ///< expansions + collapses of this update
  std::uint32_t frontLength = 0; ///< nodes in the cut, culled ones too
  double thresholdPx = 0.0; ///< in force for this update; the largest of the layers'
  /// Largest projected spacing on screen where the store holds more than is drawn, divided by its
  /// layer's errorFactor; 0 when every point in sight is drawn.
  double errorPx = 0.0;
  /// At rest: the threshold is at its target (or at the lowest that fits the budgets), no move is
  /// pending, everything wanted is drawn or cannot be had. Another update of the same view would
  /// give the same list.
  bool complete = false;
  // Which budget keeps the threshold above the target:
  bool limitedByBudget = false; ///< pointBudget
  bool limitedByGpu = false; ///< sharedSlots
  bool limitedByMemory = false; ///< heldPointBudget does, or the residency is exhausted
  /// Layers in sight of which pointBudget or sharedSlots lets nothing be drawn, ascending.
  std::vector<std::uint16_t> layersLeftOut;
  std::uint32_t failedNodes = 0; ///< nodes wanted in this view that could not be read
  /// Rows of a paged table that the front waits for: another update after
  /// Hierarchy::arrivals() has changed.
  bool rowsComing = false;
};

} // namespace pointfront
