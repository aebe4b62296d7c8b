#include "NormalsOnLoad.h"

namespace pointfront
{

std::shared_ptr<const StoredCloudFormat> withNormalsOnLoad(
  std::shared_ptr<const StoredCloudFormat> format)
{
  return format;
}

} // namespace pointfront
