#pragma once

#include "ColourChoice.h"

#include "pointfront/Style/ResolvedStyle.h"

#include <memory>

namespace pointfront
{

/// What --color-by chose, as the style of one store: points of a number of pixels. In white where
/// the store has no such attribute.
std::shared_ptr<const ResolvedStyle> chosenStyle(
  const ColourChoice& colour, const std::shared_ptr<const StoredCloud>& store);

} // namespace pointfront
