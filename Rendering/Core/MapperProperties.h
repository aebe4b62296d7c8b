#pragma once

#include "pointfront/Front/View.h"
#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Style/FrameLens.h"
#include "pointfront/Style/PointColouring.h"

#include <vector>

class vtkActor;
class vtkPolyDataMapper;
class vtkRenderer;

namespace pointfront
{

// The properties of VTK's own objects, as a point cloud follows them.
// Threads  the renderer's.

/// The colouring by the array that vtkMapper's scalar properties name. If they name none: the
/// input's active scalars if the store has them, else "rgb".
ColourRequest colourRequestOf(vtkPolyDataMapper& mapper, const StoreDescription& description);

/// The view of a renderer's camera in the coordinates of an actor's data; it works in tiled windows
/// too. With a margin it sees what lies around the viewport.
View viewOf(vtkRenderer* renderer, vtkActor* actor, const ViewportMargin& margin);
/// The camera for back ends. Positions are relative to the eye, in a parallel view to the focal
/// point, and that point is exactly zero in view coordinates, without the rounding of large
/// coordinates.
FrameCamera cameraOf(vtkRenderer* renderer, vtkActor* actor);

/// A mapper's planes as a plan has them: (n, d) in the coordinates of the actor's data.
std::vector<glm::dvec4> clippingPlanesOf(vtkPolyDataMapper& mapper, vtkActor* actor);

} // namespace pointfront
