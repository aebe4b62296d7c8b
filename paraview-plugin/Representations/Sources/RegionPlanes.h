#pragma once

#include "vtkSmartPointer.h"

class vtkBox;
class vtkPlane;
class vtkPlanes;
class vtkSelection;

namespace pointfront
{

/// ParaView's widgets and selections as planes whose normals point outwards.

/// The six sides of a box, turned by its transform.
vtkSmartPointer<vtkPlanes> planesOf(vtkBox* box);
/// Inside is where the plane's normal points away from.
vtkSmartPointer<vtkPlanes> planesOf(vtkPlane* plane);
/// The eight corners of the frustum that a selection through a view consists of, as VTK has them in
/// a selection's list: four numbers each; null if it is none.
const double* frustumOf(vtkSelection* selection);
/// Their six sides. VTK's own (vtkFrustumSelector) have origins in 32 bits: half a metre off at
/// 5,600 km.
vtkSmartPointer<vtkPlanes> planesOf(const double frustum[32]);
/// False: the box lies beside the frustum. True where that is not known, too.
bool mayOverlap(const double frustum[32], vtkPlanes* sides, const double box[6]);

} // namespace pointfront
