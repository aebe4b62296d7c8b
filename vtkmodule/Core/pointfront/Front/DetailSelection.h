#pragma once

#include "pointfront/Front/FrontDelta.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>

namespace pointfront
{

/// Decides, frame by frame, which nodes of one store are drawn, loaded and may be released: a
/// rendering front (RenderFront) or a detail level for the whole view (ViewDetail).
/// Guarantees  each class names its own. Both give draw lists near to far, ties by node; with
///             Refinement::Add each point at most once; never more than the budgets; the same
///             inputs give the same lists.
/// Never       opens a file, blocks, allocates GPU memory or includes VTK. It only names nodes.
/// Threads     one instance, one thread; View and ResidencySnapshot are snapshots.
class DetailSelection
{
public:
  virtual ~DetailSelection() = default;
  DetailSelection(const DetailSelection&) = delete;
  DetailSelection& operator=(const DetailSelection&) = delete;

  /// One frame. The result is owned by the selection and valid until the next call.
  virtual const FrontDelta& update(
    const View& view, const ResidencySnapshot& residency, const FrontLimits& limits) = 0;

  /// The demand of the last update's view on screen, on the GPU and in memory, at each threshold
  /// from the one in force upwards. Lower thresholds have the present demand; step 0 is what is
  /// drawn.
  virtual void demandCurves(DemandCurves& curves) const = 0;

  /// FRONT-10, first pass: the number of levels that a node lies below the nodes that the last
  /// update needed. 0: the update needed the node itself, which must stay. Nodes with larger
  /// numbers may be released first. Does not wait for a paged table: a node nowhere near counts as
  /// far below.
  virtual std::uint32_t distanceUnderFront(NodeIndex node) const = 0;

  /// Forgets the view.
  virtual void reset() = 0;

protected:
  DetailSelection() = default;

  /// Levels below what is needed of a node that nothing near is known of: its way up is not in
  /// memory, or it is another piece's.
  static constexpr std::uint32_t farBelow = 0xffff;
};

} // namespace pointfront
