#pragma once

#include "pointfront/Views/ViewFront.h"
#include "RendererFront.h"
#include "StoreSuccession.h"
#include "vtkPointFrontStore.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

class vtkActor;
class vtkRenderer;
class vtkWindow;

namespace pointfront
{

/// The store that a mapper draws, and what each renderer sees of it in each of its actors.
/// Threads  the renderers'.
class MapperFronts
{
public:
  /// `unseen` is called after a frame when no renderer shows the mapper any more.
  explicit MapperFronts(std::function<void()> unseen)
    : unseen_(std::move(unseen))
  {
  }

  /// Takes another store, or none, and forgets the views of the store before.
  void setStore(vtkPointFrontStore* store);
  vtkPointFrontStore* store() const { return store_; }
  /// Chooses which piece of how many pieces of the store is drawn (HierarchyPiece).
  void setPiece(int piece, int pieces);

  /// The view of an actor in a renderer, made on the first call.
  RendererFront& of(vtkRenderer* renderer, vtkActor* actor);
  RendererFront* find(vtkRenderer* renderer, vtkActor* actor);
  /// The statistics of all actors that the renderer's frame has drawn so far.
  FrameStatistics statisticsOf(vtkRenderer* renderer) const;
  /// Makes the front of a view if it has none. True if this call made it.
  bool openFront(vtkRenderer* renderer, RendererFront& view);

  /// Whether the last frame of any renderer drew the store.
  bool isSeen() const;
  /// Number of views in that window.
  std::uint32_t countIn(vtkWindow* window) const;
  /// The part of a budget of points that the views in that window may have on its GPU.
  std::uint64_t pointsOnGpu(vtkWindow* window, std::uint64_t budget) const;
  bool needsRender();

  using LayersOf = std::function<std::vector<LayerLimits>(vtkPointFrontStore&)>;
  /// Changes from a preview to its next version, or to the finished store, as soon as the successor
  /// shows as much in all views. Called in frames at rest. True when it changed.
  bool follow(vtkRenderer* renderer, vtkActor* actor,
    const std::function<FrameRequest()>& requestOf, const LayersOf& layersOf);

private:
  void takeSuccessor();
  bool isBetweenFrames(vtkRenderer* renderer) const;

  std::function<void()> unseen_;
  vtkSmartPointer<vtkPointFrontStore> store_; // before the views: their fronts refer to it
  std::shared_ptr<const HierarchyPiece> piece_;
  int pieceNumber_ = 0;
  int pieces_ = 1;
  std::map<std::pair<vtkRenderer*, vtkActor*>, RendererFront> views_;
  std::unique_ptr<StoreSuccession> succession_; ///< from the store, while it is a preview
};

} // namespace pointfront
