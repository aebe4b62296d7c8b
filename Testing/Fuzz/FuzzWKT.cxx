#include "pointfront/Query/PolygonPrism.h"
#include "pointfront/Query/WellKnownText.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

/// A polygon that was read has closed rings of finite vertices.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const auto geometry =
    pointfront::parseWellKnownText(std::string_view(reinterpret_cast<const char*>(data), size));
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
