#pragma once

#include "vtkSmartPointer.h"

#include <array>

class vtkPoints;

namespace pointfront
{

/// Points with the coordinates of `points`, whose bounds are told and not computed: lowest and
/// highest x, y and z. Copies share the coordinates' memory; points made of them (NewInstance)
/// compute their bounds. For an overview, so that boxes, planes and cameras that ParaView places by
/// the bounds of a data set span the whole cloud.
vtkSmartPointer<vtkPoints> withStoredBounds(vtkPoints* points, const std::array<double, 6>& bounds);

} // namespace pointfront
