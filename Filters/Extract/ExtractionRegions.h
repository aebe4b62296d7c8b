#pragma once

#include "pointfront/Query/Region.h"

#include "pointfront/Base/Result.h"

#include <memory>

class vtkPlanes;

namespace pointfront
{

/// Turns VTK objects into regions of a query. Errors are those of the regions.

/// In VTK's order xmin, xmax, ymin, ymax, zmin, zmax.
Result<std::shared_ptr<const Region>> regionOfBounds(const double bounds[6]);
/// Planes whose normals point outwards, as vtkPlanes and vtkExtractSelectedFrustum have them.
Result<std::shared_ptr<const Region>> regionOfPlanes(vtkPlanes* planes);

} // namespace pointfront
