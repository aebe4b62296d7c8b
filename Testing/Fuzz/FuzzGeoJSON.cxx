#include "GeoJSON.h"

#include "pointfront/Query/PolygonPrism.h"

#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const auto geometry =
    pointfront::parseGeoJSON(std::string(reinterpret_cast<const char*>(data), size));
  if (geometry)
  {
    const auto prism = pointfront::PolygonPrism::make(geometry->polygons);
    if (prism && (*prism)->contains({ 1e200, 0.0, 0.0 }))
    {
      std::abort();
    }
  }
  return 0;
}
