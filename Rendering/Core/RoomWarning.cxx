#include "RoomWarning.h"

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include <set>

namespace pointfront
{

std::string leftOutOf(const StoreDescription& store, const std::vector<std::uint16_t>& layers)
{
  if (!layers.empty() && !isLayered(store))
  {
    return store.path;
  }
  std::set<std::uint16_t> codes; // several drawings may each leave one out
  for (const std::uint16_t layer : layers)
  {
    if (layer < store.layers.size())
    {
      codes.insert(store.layers[layer].objectClass);
    }
  }
  std::string text;
  for (const std::uint16_t code : codes)
  {
    text += (text.empty() ? "class " : ", class ") + std::to_string(code);
  }
  return text;
}

std::string roomWarning(
  const StoreDescription& store, const std::vector<std::uint16_t>& layers, bool byGpuMemory)
{
  const std::string classes = isLayered(store) ? " of " + leftOutOf(store, layers) : "";
  return store.path + ": the picture shows nothing" + classes + ", for which " +
    (byGpuMemory ? "GPUMemoryBudget has no room: a tree takes 65 KiB at least, and each of several "
                   "clouds in a window 65 KiB more"
                 : "PointBudget has no point") +
    "; raise it";
}

} // namespace pointfront
