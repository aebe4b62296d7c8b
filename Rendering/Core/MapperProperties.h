#pragma once

#include "pointfront/Style/PointColouring.h"

#include "pointfront/Front/View.h"

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

} // namespace pointfront
