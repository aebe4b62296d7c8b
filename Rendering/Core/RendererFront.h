#pragma once

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Plan/FrameStatistics.h"
#include "pointfront/Plan/StoreView.h"

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkWeakPointer.h>

#include <functional>
#include <optional>

namespace pointfront
{

/// Whether the user moves the view of the renderer's window: VTK's interactors then ask for a rate.
bool isInteracting(vtkRenderer* renderer);

/// One renderer's view of a mapper's store in one actor, and the state of the renderer's frames.
/// Threads  the renderer's.
struct RendererFront
{
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkActor> Actor;
  StoreView View;
  /// The plan of the frame that is being drawn. It pins its nodes, so it is dropped at the end of
  /// the frame.
  std::optional<FramePlan> Plan;
  bool NewFrame = true; ///< the renderer began a frame, and this mapper has not been drawn in it
  bool Seen = true; ///< the mapper was drawn in the renderer's last frame
  bool FirstDrawing = false;
  bool UploadsLeft = false;
  bool Complete = false;
  /// Budgets left something without a point in the last frame. Clouds that were drawn after it may
  /// have come down since, so one more frame is due before that is final.
  bool LeftOut = false;
  bool LeftOutBefore = false; ///< and in the frame before
  bool Announced = false; ///< ViewCompleteEvent was invoked for that view
  FrameStatistics Statistics; ///< its last frame's

  /// `unseen` is called after a frame of the renderer in which the actor was not drawn: it
  /// is hidden, out of sight or removed.
  RendererFront(vtkRenderer* renderer, vtkActor* actor, std::function<void()> unseen);
  ~RendererFront();
  RendererFront(const RendererFront&) = delete;
  RendererFront& operator=(const RendererFront&) = delete;

  /// Whether a frame is due, by StoreView's rhythm. A view that motion left incomplete is due as
  /// soon as it rests. Never true for a mapper that the renderer does not show: its frame would
  /// stay due for ever.
  bool NeedsRender();

private:
  void EndFrame();

  std::function<void()> Unseen;
  unsigned long StartTag = 0;
  unsigned long EndTag = 0;
};

} // namespace pointfront
