#include "pointfront/Query/TextRegion.h"

#include "pointfront/Query/LineCorridor.h"
#include "pointfront/Query/PolygonPrism.h"
#include "pointfront/Query/WellKnownText.h"

namespace pointfront
{
namespace
{

template <typename T>
Result<std::shared_ptr<const Region>> anyRegion(const Result<std::shared_ptr<const T>>& region)
{
  if (!region)
  {
    return region.error();
  }
  return std::shared_ptr<const Region>(*region);
}

} // namespace

Result<std::shared_ptr<const Region>> regionOfText(std::string_view text, double distance)
{
  const Result<PlanarGeometry> geometry = parseWellKnownText(text);
  if (!geometry)
  {
    return geometry.error();
  }
  if (!geometry->crs.empty())
  {
    return makeError(Error::Kind::BadArgument,
      "the text names a coordinate reference system (" + geometry->crs +
        "); give its coordinates in the store's, without an SRID");
  }
  if (geometry->lines.empty())
  {
    return anyRegion(PolygonPrism::make(geometry->polygons));
  }
  if (!geometry->polygons.empty() || !(distance > 0.0))
  {
    return makeError(
      Error::Kind::BadArgument, "lines want a line distance above 0, and no areas beside them");
  }
  return anyRegion(LineCorridor::make(geometry->lines, distance));
}

} // namespace pointfront
