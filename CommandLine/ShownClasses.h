#pragma once

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <vector>

class vtkPointFrontMapper;

namespace pointfront
{

struct StoreDescription;

/// Hides every class of a layered store that is not in `shown`, sorted codes 0 to 255; hidden
/// classes are neither loaded nor drawn (LAYERS-11). Gives the number of points of the shown ones.
/// BadArgument for a store that keeps no tree a class.
Result<std::uint64_t> showOnly(const std::vector<std::uint8_t>& shown,
  const StoreDescription& store, vtkPointFrontMapper* mapper);

} // namespace pointfront
