#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Style/StyleSheet.h"

#include <string>

namespace pointfront
{

/// A complete style with a store's columns looked up. `sheet` says what is true of all styles;
/// `place` begins the message of an error.
Result<ResolvedStyle> resolveStyle(const StyleSheet& sheet, const LayerStyle& style,
  const StoreDescription& store, const StoreSurroundings& surroundings, std::string place);

} // namespace pointfront
