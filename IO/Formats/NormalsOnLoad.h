#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <memory>

namespace pointfront
{

/// The format, whose clouds without normals have some that are computed while nodes load. In a
/// build without normals (POINTFRONT_NORMALS) the format itself.
std::shared_ptr<const StoredCloudFormat> withNormalsOnLoad(
  std::shared_ptr<const StoredCloudFormat> format);

} // namespace pointfront
