#pragma once

#include "pointfront/Plan/DetailGrowth.h"
#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Views/ViewFront.h"

#include <vtkRenderer.h>
#include <vtkWeakPointer.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

namespace pointfront
{

/// Whether the user moves the view of the renderer's window: VTK's interactors then ask for a rate.
bool isInteracting(vtkRenderer* renderer);

/// What one renderer sees of a mapper's store: the front, and how far its frames are.
/// Threads  the renderer's.
struct RendererView
{
  using Clock = std::chrono::steady_clock;

  vtkWeakPointer<vtkRenderer> Renderer;
  std::unique_ptr<ViewFront> Front;
  /// Of the frame that is being drawn. It pins its nodes, so it goes with the frame.
  std::optional<FramePlan> Plan;
  DetailGrowth Growth; ///< what is shown of what the front draws
  bool NewFrame = true; ///< the renderer began a frame, and this mapper has not been drawn in it
  bool Seen = true; ///< the mapper was drawn in the renderer's last frame
  bool FirstDrawing = false;
  bool UploadsLeft = false;
  bool Complete = false;
  bool Announced = false; ///< ViewCompleteEvent was invoked for that view
  bool Ahead = false; ///< the front was moved since the last frame
  bool Due = false; ///< NeedsRender() said so, and no frame was drawn since
  Clock::time_point DrawnAt; ///< end of the last frame's first drawing
  double DrawingMs = 0.0; ///< what a frame took lately
  FrameDemand Demand; ///< of the last frame, its view in the store's coordinates

  /// `unseen` is called after a frame of the renderer without this mapper: its actor is hidden, out
  /// of sight or no longer there.
  RendererView(vtkRenderer* renderer, std::function<void()> unseen);
  ~RendererView();
  RendererView(const RendererView&) = delete;
  RendererView& operator=(const RendererView&) = delete;

  /// Whether a frame is due. A view at rest that is being loaded is drawn a quarter of the time at
  /// most: till the next frame is due its front is moved here, so that what it asks for next does
  /// not wait for a slow drawing. A view that motion left incomplete is due as soon as it rests.
  /// Once a frame is due it stays so until it is drawn. Never for what the renderer does not show:
  /// it would stay due for ever.
  bool NeedsRender();

  /// Of the frame that is being drawn; a view that is to be complete at once does not grow.
  GrowthMoment MomentOf(double growthMilliseconds) const;

private:
  void EndFrame();

  std::function<void()> Unseen;
  unsigned long StartTag = 0;
  unsigned long EndTag = 0;
};

} // namespace pointfront
