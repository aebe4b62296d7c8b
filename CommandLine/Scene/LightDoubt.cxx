#include "LightDoubt.h"

#include "pointfront/Points/NormalAttribute.h"

#include <algorithm>

namespace pointfront
{

std::string doubtOfLight(
  const StyleSheet& sheet, const std::vector<std::shared_ptr<const StoredCloud>>& clouds)
{
  const std::optional<StyleLight>& light = sheet.standard.light;
  const bool lit = light && light->on && sheet.standard.technique != Technique::Spheres;
  const std::string name = normalAttribute().name;
  const bool has = std::any_of(clouds.begin(), clouds.end(),
    [&name](const auto& cloud) { return cloud->description().schema.find(name).has_value(); });
  return lit && !has ? "the light shows nothing, for no point has a normal: build with --normals "
                       "pca, or draw spheres"
                     : "";
}

} // namespace pointfront
