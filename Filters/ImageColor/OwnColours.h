#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributePass.h"

#include <cstddef>

namespace pointfront
{

/// Whether the 16-bit colours of a source have 8 bits, as a build decides it of a file: no value is
/// above 255. Reads all points where nobody knows and none of the first is.
/// Errors  those of the source; Cancelled.
Result<bool> haveEightBits(
  const PointSource& source, std::size_t column, const PassResources& resources);

} // namespace pointfront
