#pragma once

#include "pointfront/Views/HierarchyPiece.h"
#include "pointfront/Views/ViewFront.h"
#include "vtkPointFrontStore.h"

#include "pointfrontRenderingCoreModule.h" // for the export macro

#include <map>
#include <memory>

#include <vtkSmartPointer.h>

class vtkRenderer;

namespace pointfront
{

/// Going over from a preview to its next version, or to the finished store, without a gap: fronts
/// on the successor are moved and loaded beside those that are drawn, and taken over when they show
/// all that the view asks for.
/// Memory   until then both stores have nodes in host memory, together within the process's budget.
/// Threads  one thread (the renderer's).
/// Source   Futterlieb et al. 2016, section 3.3.1 (SMOOTH-1).
class POINTFRONTRENDERINGCORE_EXPORT StoreSuccession
{
public:
  /// A piece of the successor, whose memory budget becomes that of `preview`.
  StoreSuccession(vtkSmartPointer<vtkPointFrontStore> successor, vtkPointFrontStore& preview,
    int piece, int pieces);

  /// Moves the front of that renderer on. `demand`: what is asked of the front that is drawn, but
  /// for the layers, which are the successor's.
  void advance(vtkRenderer* renderer, FrameDemand demand);
  /// The front of that renderer shows all that its view asks for.
  bool ready(vtkRenderer* renderer) const;
  /// Something arrived, or work is left.
  bool wantsUpdate() const;

  const vtkSmartPointer<vtkPointFrontStore>& store() const { return store_; }
  const std::shared_ptr<const HierarchyPiece>& piece() const { return piece_; }
  /// The front of that renderer, to be drawn from now on; null if it never advanced.
  std::unique_ptr<ViewFront> take(vtkRenderer* renderer);

private:
  vtkSmartPointer<vtkPointFrontStore> store_; // before the fronts, which refer to it
  std::shared_ptr<const HierarchyPiece> piece_;
  std::map<vtkRenderer*, std::unique_ptr<ViewFront>> fronts_;
};

} // namespace pointfront
