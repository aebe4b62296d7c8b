#pragma once

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
};

/// What one update may do and strives for.
struct FrontLimits
{
  double targetErrorPx = 1.0;       ///< the threshold stops falling here
  double initialErrorPx = 60.0;     ///< FRONT-7: where it starts
  /// FRONT-6: expansions + collapses; the rest goes on next frame.
  std::uint32_t movesPerFrame = 64;
  std::uint64_t pointBudget = 0;    ///< FRONT-8: most points drawn; 0: no limit
  std::uint32_t requestLimit = 256; ///< most requests handed out by one update
  bool interacting = false;         ///< in motion the threshold does not fall below motionErrorPx
  double motionErrorPx = 0.0;       ///< FRONT-7: raised by the caller until the frame rate holds
};

struct DrawItem
{
  NodeIndex node = noNode;
  std::uint32_t pointCount = 0; ///< a prefix of the node's points
  float errorPx = 0.0f;         ///< projected spacing of this node
  float distance = 0.0f;        ///< from the eye to its sphere
};

struct LoadRequest
{
  NodeIndex node = noNode;
  double priority = 0.0; ///< larger is sooner; the projected error in px
};

/// What one update decided. Owned by the front, valid until its next update.
struct FrontDelta
{
  std::vector<DrawItem> draw;        ///< near to far, ties by node: two runs give the same list
  std::vector<LoadRequest> requests; ///< all that is wanted now, highest priority first
  std::uint64_t pointsDrawn = 0;
  std::uint32_t moves = 0;           ///< expansions + collapses of this update
  std::uint32_t frontLength = 0;     ///< nodes in the cut, culled ones too
  double thresholdPx = 0.0;          ///< in force for this update
  /// Largest projected spacing of a visible front node that could be refined.
  double errorPx = 0.0;
  /// Nothing to do: threshold at its target, no move pending, nothing wanted that is not resident.
  bool complete = false;
  bool limitedByBudget = false;      ///< settled, but pointBudget keeps it above the target
  std::uint32_t failedNodes = 0;     ///< visible nodes whose refinement could not be read
};

/// The cut through a hierarchy that is drawn this frame.
/// Shapes      FrontDelta::draw is ordered near to far, ties by NodeIndex: two runs give the same
///             list.
/// Units       error in pixels; distances in world units.
/// Guarantees  detail that was on screen does not disappear while its replacement is loading. The
///             nodes of the front are a cut: no node of it is an ancestor of another, each
///             root-to-leaf path meets it once. With Refinement::Add the ancestors of the front are
///             drawn too, each point once.
/// Never       opens a file, blocks, allocates GPU memory or includes VTK. It only names nodes. In
///             the steady state it does not allocate.
/// Errors      none; a node that failed to load stays unrequested and its parent goes on being
///             drawn.
/// Threads     one instance, one thread; View and ResidencyView are snapshots.
/// Source      Richter & Doellner 2010, section 3.2.1 (the rendering front); FRONT-4..8.
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

  /// FRONT-10, first pass: levels that a node lies below the front; 0 for front nodes and those
  /// above (which must stay), larger for what may be released first.
  std::uint32_t distanceUnderFront(NodeIndex node) const;

  /// Back to the roots and the initial threshold.
  void reset();

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
