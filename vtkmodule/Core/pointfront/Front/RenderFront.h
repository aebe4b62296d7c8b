#pragma once

#include "pointfront/Front/DemandCurve.h"
#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// What of a store is in memory at this moment. A snapshot for the length of one update.
class ResidencyView
{
public:
  enum class State : std::uint8_t
  {
    Absent,
    Resident,
    Failed ///< could not be read; is not asked for again
  };
  virtual ~ResidencyView() = default;
  virtual State state(NodeIndex node) const = 0;
  /// Changes whenever the state of any node does, so that an update in which nothing changed can
  /// end at once. 0: not known, every update asks anew.
  virtual std::uint64_t revision() const { return 0; }
  /// True when nothing more can come: the memory is full of what the front needs, and no
  /// request that waits fits. The view is then as complete as this memory allows.
  virtual bool exhausted() const { return false; }
};

/// A limit of points that a front shares with others (SharedDemand.h).
struct SharedLimit
{
  std::uint64_t points = 0; ///< of all together, in points of this store; 0: no limit
  /// What the others take, in points of this store; step 0 is what they have at this moment. Not
  /// null where there is a limit, and alive while the limits are in use.
  const DemandCurve* elsewhere = nullptr;

  std::uint64_t leftAt(double px) const
  {
    const std::uint64_t others = elsewhere->at(px);
    return points > others ? points - others : 0;
  }
};

/// What one update may do and strives for.
struct FrontLimits
{
  double targetErrorPx = 1.0;       ///< the threshold stops falling here
  double initialErrorPx = 60.0;     ///< FRONT-7: where it starts
  /// FRONT-6: expansions + collapses; the rest goes on next frame.
  std::uint32_t movesPerFrame = 64;
  std::uint64_t pointBudget = 0;    ///< FRONT-8: most points drawn; 0: no limit
  /// Most points in the nodes that the view needs in memory, drawn or not (a node is held whole
  /// although a prefix of it may be drawn); 0: no limit. Budget bytes / bytes of a decoded point,
  /// with some room to spare, makes a view that needs more settle at the best error that fits.
  std::uint64_t heldPointBudget = 0;
  SharedLimit sharedDrawn;          ///< as pointBudget, over all clouds of a window
  SharedLimit sharedHeld;           ///< as heldPointBudget, over all stores of a process
  /// Changes whenever one of the curves of the shared limits does.
  std::uint64_t sharedRevision = 0;
  std::uint32_t requestLimit = 256; ///< most requests handed out by one update
  bool interacting = false;         ///< in motion the threshold does not fall below motionErrorPx
  double motionErrorPx = 0.0;       ///< FRONT-7: raised by the caller until the frame rate holds
  /// FRONT-9: ask also for the siblings (out of sight) of what is asked for, after everything that
  /// is in sight and only into free memory. Off for a single still picture.
  bool prefetchSiblings = true;
  /// LAYERS-11: by number of the layer; layers beyond the list are as by default.
  std::vector<LayerLimits> layers;
};

struct DrawItem
{
  NodeIndex node = noNode;
  std::uint32_t pointCount = 0; ///< a prefix of the node's points (PointPrefix.h), at least 1
  float errorPx = 0.0f;         ///< projected spacing of this node, whatever its layer's factor
  float distance = 0.0f;        ///< from the eye to its sphere
};

struct LoadRequest
{
  NodeIndex node = noNode;
  double priority = 0.0; ///< larger is sooner; the error on screen that it would mend, in px
  bool optional = false; ///< not needed for this view: after all others, into free memory only
};

/// What one update decided. Owned by the front, valid until its next update.
struct FrontDelta
{
  std::vector<DrawItem> draw;        ///< near to far, ties by node: two runs give the same list
  /// All that is wanted now: optional ones last, highest priority first, ties by node.
  std::vector<LoadRequest> requests;
  std::uint64_t pointsDrawn = 0;
  std::uint32_t moves = 0;           ///< expansions + collapses of this update
  std::uint32_t frontLength = 0;     ///< nodes in the cut, culled ones too
  double thresholdPx = 0.0;          ///< in force for this update; the largest of the layers'
  /// Largest projected spacing on screen where the store holds more than is drawn, divided by its
  /// layer's errorFactor; 0 when every point in sight is drawn.
  double errorPx = 0.0;
  /// At rest: the threshold is at its target (or at the lowest that fits the budgets), no move is
  /// pending, everything wanted is drawn or cannot be had. Another update of the same view would
  /// give the same list.
  bool complete = false;
  bool limitedByBudget = false;      ///< pointBudget keeps the threshold above the target
  bool limitedByMemory = false;      ///< heldPointBudget does, or the residency is exhausted
  std::uint32_t failedNodes = 0;     ///< nodes wanted in this view that could not be read
  /// Rows of a paged table that the front waits for: another update after
  /// Hierarchy::arrivals() has changed.
  bool rowsComing = false;
};

/// The cut through a hierarchy that is drawn this frame.
/// Front       the cut that the threshold asks for is kept from update to update and moved by the
///             table alone (FRONT-5, -6); of it is drawn what is resident. Nodes that are missing
///             are requested, and stand-ins drawn: the ancestors (Add: they are drawn anyway;
///             Replace: a node stands in until all of its children are there).
/// Threshold   starts at initialErrorPx and falls by a fifth an update while moves are not used up
///             and requests not piled up (FRONT-7). Budgets act on it: the lowest threshold whose
///             demand fits is taken, so the largest errors win, and a view that needs more settles
///             instead of thrashing. Layers have factors, shares and switches (LayerLimits.h).
/// Shapes      FrontDelta::draw is ordered near to far, ties by NodeIndex: two runs give the same
///             list.
/// Units       error in pixels; distances in world units.
/// Guarantees  detail that was on screen does not disappear while its replacement is loading. The
///             nodes of the front are a cut: no node of it is an ancestor of another, each
///             root-to-leaf path meets it once. With Refinement::Add the ancestors of what is drawn
///             are drawn too, whole, each point once; with Replace no ancestor of what is drawn
///             is. Never more than pointBudget points.
/// Never       opens a file, blocks, allocates GPU memory or includes VTK. It only names nodes. In
///             the steady state it does not allocate.
/// Errors      none; a node that failed to load stays unrequested, and what stands in goes on being
///             drawn. With Add its descendants, which are stored apart, are still refined into.
/// Threads     one instance, one thread; View and ResidencyView are snapshots.
/// Source      Richter & Doellner 2010, section 3.2.1 (the rendering front); FRONT-4..8;
///          Richter, Discher & Doellner 2015, section 4.2 (LAYERS-11).
class RenderFront
{
public:
  explicit RenderFront(std::shared_ptr<const Hierarchy> hierarchy);
  ~RenderFront();
  RenderFront(const RenderFront&) = delete;
  RenderFront& operator=(const RenderFront&) = delete;

  /// One frame. The result is owned by the front and valid until the next call.
  const FrontDelta& update(
    const View& view, const ResidencyView& residency, const FrontLimits& limits);

  /// What the last update's view takes at each threshold from the one in force on, in points: on
  /// screen and in memory. Below that it takes what it takes now; step 0 is what is drawn.
  void demandCurves(DemandCurve& drawn, DemandCurve& held) const;

  /// FRONT-10, first pass: levels that a node lies below the part of the front that the last
  /// update needed; 0 for what it needed itself (which must stay), larger for what may be released
  /// first. Branches out of sight count from their last ancestor in sight; of a hidden layer
  /// nothing is needed, not even its root. Does not wait for a paged table: what is nowhere near
  /// the front is far below it.
  std::uint32_t distanceUnderFront(NodeIndex node) const;

  /// Back to the roots and the initial threshold.
  void reset();

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
