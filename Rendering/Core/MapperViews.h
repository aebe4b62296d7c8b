#pragma once

#include "pointfront/Views/ViewFront.h"
#include "RendererView.h"
#include "StoreSuccession.h"
#include "vtkPointFrontStore.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

class vtkRenderer;
class vtkWindow;

namespace pointfront
{

/// The store that a mapper draws, and what each of its renderers sees of it.
/// Threads  the renderers'.
class MapperViews
{
public:
  /// `unseen` is called after a frame that showed nothing of it, when no renderer does any more.
  explicit MapperViews(std::function<void()> unseen)
    : unseen_(std::move(unseen))
  {
  }

  /// Another store, or none: what was seen of the one before is gone.
  void setStore(vtkSmartPointer<vtkPointFrontStore> store);
  vtkPointFrontStore* store() const { return store_; }
  /// Of a store: which of how many pieces is drawn (HierarchyPiece).
  void setPiece(int piece, int pieces);

  /// Made when it is not there.
  RendererView& of(vtkRenderer* renderer);
  RendererView* find(vtkRenderer* renderer);
  /// A view's front, made when it is not there. False if it was.
  bool openFront(vtkRenderer* renderer, RendererView& view);

  /// Renderers of that window.
  std::uint32_t countIn(vtkWindow* window) const;
  /// Of a budget of points, what the views in that window may have on its GPU.
  std::uint64_t pointsOnGpu(vtkWindow* window, std::uint64_t budget) const;
  bool needsRender();

  using LayersOf = std::function<std::vector<LayerLimits>(vtkPointFrontStore&)>;
  /// Goes over to the next version of the preview that is drawn, or to the finished store, once
  /// that shows as much of all views. For a frame at rest. True when it did.
  bool follow(
    vtkRenderer* renderer, const std::function<FrameDemand()>& demand, const LayersOf& layersOf);

private:
  bool isSeen() const;
  void takeSuccessor();

  std::function<void()> unseen_;
  vtkSmartPointer<vtkPointFrontStore> store_; // before the views: their fronts refer to it
  std::shared_ptr<const HierarchyPiece> piece_;
  int pieceNumber_ = 0;
  int pieces_ = 1;
  std::map<vtkRenderer*, RendererView> views_;
  std::unique_ptr<StoreSuccession> succession_; ///< from the store, while it is a preview
};

} // namespace pointfront
