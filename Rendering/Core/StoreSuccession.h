#pragma once

#include "pointfront/Views/HierarchyPiece.h"
#include "pointfront/Views/ViewFront.h"
#include "vtkPointFrontStore.h"

#include "pointfrontRenderingCoreModule.h" // for the export macro

#include <map>
#include <memory>

#include <vtkSmartPointer.h>

namespace pointfront
{

struct RendererFront;

/// Changes from a preview to its next version, or to the finished store, without a gap. Fronts on
/// the successor move and load beside the fronts that are drawn, and replace them when they show
/// everything that the view asks for.
/// Memory   until then both stores have nodes in host memory, together within the process's budget.
/// Threads  one thread (the renderer's).
/// Source   Futterlieb et al. 2016, section 3.3.1 (SMOOTH-1).
class POINTFRONTRENDERINGCORE_EXPORT StoreSuccession
{
public:
  /// A piece of the successor, whose memory budget becomes that of `preview`.
  StoreSuccession(vtkSmartPointer<vtkPointFrontStore> successor, vtkPointFrontStore& preview,
    int piece, int pieces);

  /// Moves the successor's front for that view. `request`: the request of the front that is
  /// drawn, with the layers of the successor.
  void advance(const RendererFront* view, FrameRequest request);
  /// Whether its front shows everything that the view asks for.
  bool ready(const RendererFront* view) const;
  /// Whether nodes arrived, or work is left.
  bool wantsUpdate() const;

  const vtkSmartPointer<vtkPointFrontStore>& store() const { return store_; }
  const std::shared_ptr<const HierarchyPiece>& piece() const { return piece_; }
  /// The front of that view, to be drawn from now on; null if it never advanced.
  std::unique_ptr<ViewFront> take(const RendererFront* view);

private:
  vtkSmartPointer<vtkPointFrontStore> store_; // before the fronts, which refer to it
  std::shared_ptr<const HierarchyPiece> piece_;
  std::map<const RendererFront*, std::unique_ptr<ViewFront>> fronts_;
};

} // namespace pointfront
