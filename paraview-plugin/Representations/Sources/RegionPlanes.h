#pragma once

#include "vtkSmartPointer.h"

class vtkBox;
class vtkPlane;
class vtkPlanes;
class vtkSelection;

namespace pointfront
{

/// What ParaView's widgets and selections mean as planes whose normals point outwards.

/// The six sides of a box, turned by its transform.
vtkSmartPointer<vtkPlanes> planesOf(vtkBox* box);
/// Inside is where the plane's normal points away from.
vtkSmartPointer<vtkPlanes> planesOf(vtkPlane* plane);
/// The frustum that a selection through a view consists of; null if it is none.
vtkSmartPointer<vtkPlanes> planesOf(vtkSelection* selection);

} // namespace pointfront
