#include "NormalsOnLoad.h"

#include "NodePlanes.h"

#include "pointfront/InPlace/CloudWithNormals.h"

#include <utility>

namespace pointfront
{

std::shared_ptr<const StoredCloudFormat> withNormalsOnLoad(
  std::shared_ptr<const StoredCloudFormat> format)
{
  return std::make_shared<FormatWithNormals>(
    std::move(format), std::make_shared<const NodePlanes>());
}

} // namespace pointfront
