#include "ShownClasses.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkPointFrontMapper.h"

#include <algorithm>

namespace pointfront
{

Result<std::uint64_t> showOnly(const std::vector<std::uint8_t>& shown,
  const StoreDescription& store, vtkPointFrontMapper* mapper)
{
  if (store.layers.size() == 1 && store.layers.front().name == "all")
  {
    return makeError(Error::Kind::BadArgument,
      store.path + ": --classes needs a store with a tree for each class, and this one has one for "
      "all; build it with --layers class, or export the classes");
  }
  std::uint64_t points = 0;
  for (const Layer& layer : store.layers)
  {
    const bool visible = std::binary_search(shown.begin(), shown.end(), layer.objectClass);
    mapper->SetClassVisibility(layer.objectClass, visible);
    points += visible ? layer.pointCount : 0;
  }
  return points;
}

} // namespace pointfront
