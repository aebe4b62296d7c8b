#pragma once

#include "pointfront/Query/Region.h"

#include "pointfront/Base/Result.h"

#include <memory>
#include <string>

class vtkPlanes;

namespace pointfront
{

/// What VTK objects and texts mean as regions of a query. Errors are those of the regions.

/// In VTK's order xmin, xmax, ymin, ymax, zmin, zmax.
Result<std::shared_ptr<const Region>> regionOfBounds(const double bounds[6]);
/// Planes whose normals point outwards, as vtkPlanes and vtkExtractSelectedFrustum have them.
Result<std::shared_ptr<const Region>> regionOfPlanes(vtkPlanes* planes);
/// Areas of a well-known text; lines with a distance above 0.
Result<std::shared_ptr<const Region>> regionOfText(const std::string& text, double distance);

} // namespace pointfront
