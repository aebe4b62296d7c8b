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

/// One renderer's view of a mapper's store: the front, and the state of the renderer's frames.
/// Threads  the renderer's.
struct RendererFront
{
  using Clock = std::chrono::steady_clock;

  vtkWeakPointer<vtkRenderer> Renderer;
  std::unique_ptr<ViewFront> Front;
  /// The plan of the frame that is being drawn. It pins its nodes, so it is dropped at the end of
  /// the frame.
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
  FrameRequest Demand; ///< of the last frame, its view in the store's coordinates

  /// `unseen` is called after a frame of the renderer in which this mapper was not drawn: its actor
  /// is hidden, out of sight or removed.
  RendererFront(vtkRenderer* renderer, std::function<void()> unseen);
  ~RendererFront();
  RendererFront(const RendererFront&) = delete;
  RendererFront& operator=(const RendererFront&) = delete;

  /// Whether a frame is due. A view at rest that is being loaded is drawn a quarter of the time at
  /// most. Until the next frame is due, this function moves the front, so that its next requests do
  /// not wait for a slow drawing. A view that motion left incomplete is due as soon as it rests. A
  /// due frame stays due until it is drawn. Never true for a mapper that the renderer does not
  /// show: its frame would stay due for ever.
  bool NeedsRender();

  /// The time of the frame that is being drawn; in a view that waits until it is complete nothing
  /// grows.
  GrowthMoment MomentOf(double growthMilliseconds) const;

private:
  void EndFrame();

  std::function<void()> Unseen;
  unsigned long StartTag = 0;
  unsigned long EndTag = 0;
};

} // namespace pointfront
