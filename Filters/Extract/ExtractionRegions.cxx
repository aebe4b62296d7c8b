#include "ExtractionRegions.h"

#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/ConvexRegion.h"

#include <vtkDataArray.h>
#include <vtkPlanes.h>
#include <vtkPoints.h>

#include <iomanip>
#include <locale>
#include <sstream>
#include <vector>

namespace pointfront
{
namespace
{

using AnyRegion = Result<std::shared_ptr<const Region>>;

template <typename T>
AnyRegion anyRegion(const Result<std::shared_ptr<const T>>& region)
{
  return region ? AnyRegion(std::shared_ptr<const Region>(*region)) : AnyRegion(region.error());
}

} // namespace

AnyRegion regionOfBounds(const double bounds[6])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis];
    const double high = bounds[2 * axis + 1];
    if (low > high)
    {
      std::ostringstream message;
      message.imbue(std::locale::classic());
      message << std::setprecision(12) << "the box has its lower end above its upper one along "
              << "xyz"[axis] << " (" << low << " above " << high
              << "): give xmin, xmax, ymin, ymax, zmin, zmax";
      return makeError(Error::Kind::BadArgument, message.str());
    }
  }
  return anyRegion(BoxRegion::make(
    Bounds{ { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } }));
}

AnyRegion regionOfPlanes(vtkPlanes* planes)
{
  vtkPoints* const origins = planes->GetPoints();
  vtkDataArray* const normals = planes->GetNormals();
  if (origins == nullptr || normals == nullptr ||
    origins->GetNumberOfPoints() != normals->GetNumberOfTuples())
  {
    return makeError(
      Error::Kind::BadArgument, "the planes have not as many origins as they have normals");
  }
  std::vector<glm::dvec4> inward;
  for (vtkIdType i = 0; i < origins->GetNumberOfPoints(); ++i)
  {
    double origin[3];
    double normal[3];
    origins->GetPoint(i, origin);
    normals->GetTuple(i, normal);
    inward.emplace_back(-normal[0], -normal[1], -normal[2],
      normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2]);
  }
  return anyRegion(ConvexRegion::make(std::move(inward)));
}

} // namespace pointfront
