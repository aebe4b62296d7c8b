#pragma once

#include "pointfront/Front/FrontDelta.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>

namespace pointfront
{

/// Decides, frame by frame, what of one store is drawn, loaded and may be released: a rendering
/// front (RenderFront) or a detail level for the whole view (ViewDetail).
/// Guarantees  as each says; of both: draw lists near to far, ties by node; with Refinement::Add
///             each point at most once; never more than the budgets; the same inputs give the same
///             lists.
/// Never       opens a file, blocks, allocates GPU memory or includes VTK. It only names nodes.
/// Threads     one instance, one thread; View and ResidencyView are snapshots.
class DetailSelection
{
public:
  virtual ~DetailSelection() = default;
  DetailSelection(const DetailSelection&) = delete;
  DetailSelection& operator=(const DetailSelection&) = delete;

  /// One frame. The result is owned by the selection and valid until the next call.
  virtual const FrontDelta& update(
    const View& view, const ResidencyView& residency, const FrontLimits& limits) = 0;

  /// What the last update's view takes at each threshold from the one in force on, on
  /// screen, on the GPU and in memory. Below that it takes what it takes now; step 0 is what is
  /// drawn.
  virtual void demandCurves(DemandCurves& curves) const = 0;

  /// FRONT-10, first pass: levels that a node lies below what the last update needed; 0 for what it
  /// needed itself (which must stay), larger for what may be released first. Does not wait for a
  /// paged table: what is nowhere near counts as far below.
  virtual std::uint32_t distanceUnderFront(NodeIndex node) const = 0;

  /// Forgets the view.
  virtual void reset() = 0;

protected:
  DetailSelection() = default;
};

} // namespace pointfront
