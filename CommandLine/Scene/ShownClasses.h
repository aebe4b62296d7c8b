#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Front/LayerLimits.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

struct StoreDescription;

/// Which of a store's layers are drawn; the others are neither loaded nor drawn (LAYERS-11).
struct ShownClasses
{
  std::vector<LayerLimits> layers; ///< by number of the store's layer
  std::uint64_t points = 0; ///< number of points that are drawn

  /// `codes`: sorted codes 0 to 255; empty: all that the store has.
  /// Errors  BadArgument: the store keeps no tree a class.
  static Result<ShownClasses> choose(
    const std::vector<std::uint8_t>& codes, const StoreDescription& store);
};

/// Options and style leave no class that any of the stores has.
Error noClassShown();

/// Shares of classes are asked for, and no store of the scene has a tree for each class.
Error noClassTrees(const std::string& store);

} // namespace pointfront
