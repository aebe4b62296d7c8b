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

// What the properties of VTK's own objects ask of a point cloud.
// Threads  the renderer's.

/// The array that vtkMapper's scalar properties name, and how they map it. Without a choice: the
/// input's active scalars if the store has them, else "rgb".
ColourRequest colourRequestOf(vtkPolyDataMapper& mapper, const StoreDescription& description);

/// A renderer's camera in the coordinates of an actor's data, also in tiled windows.
View viewOf(vtkRenderer* renderer, vtkActor* actor);
/// The same for back ends: positions are taken relative to the eye, in a parallel view to the focal
/// point, and what rounding of large coordinates left of that point in the view is zero.
FrameCamera cameraOf(vtkRenderer* renderer, vtkActor* actor);

/// Lenses of a renderer's viewport as they lie in what is drawn of it: in a window that is a tile
/// of a larger picture, that tile.
void placeInTile(vtkRenderer* renderer, std::vector<FrameLens>& lenses);

/// A mapper's planes as a plan has them: (n, d) in the coordinates of the actor's data.
std::vector<glm::dvec4> clippingPlanesOf(vtkPolyDataMapper& mapper, vtkActor* actor);

} // namespace pointfront
