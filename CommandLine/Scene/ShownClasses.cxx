#include "ShownClasses.h"

#include "pointfront/Store/StoredCloud.h"

#include <algorithm>

namespace pointfront
{

Result<ShownClasses> ShownClasses::choose(
  const std::vector<std::uint8_t>& codes, const StoreDescription& store)
{
  ShownClasses shown;
  if (codes.empty())
  {
    shown.layers.resize(store.layers.size());
    shown.points = store.pointCount;
    return shown;
  }
  if (store.layers.size() == 1 && store.layers.front().name == "all")
  {
    return makeError(Error::Kind::BadArgument,
      store.path +
        ": --classes needs a store with a tree for each class, and this one has one for "
        "all; build it with --layers class, or export the classes");
  }
  for (const Layer& layer : store.layers)
  {
    LayerLimits limits;
    limits.visible = std::binary_search(codes.begin(), codes.end(), layer.objectClass);
    shown.layers.push_back(limits);
    shown.points += limits.visible ? layer.pointCount : 0;
  }
  return shown;
}

Error noClassShown()
{
  return makeError(Error::Kind::BadArgument,
    "no store here has a point of these classes (info lists them): --classes, or the style by "
    "show_classes and visible, hides all others");
}

Error noClassTrees(const std::string& store)
{
  return makeError(Error::Kind::BadArgument,
    store +
      ": a class's share of the budgets (budget_share, --class-share) needs a store with a tree "
      "for "
      "each class, and this one has one for all; build it with --layers class");
}

} // namespace pointfront
