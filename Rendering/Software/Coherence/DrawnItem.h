#pragma once

#include "RasterItems.h"
#include "TechniquePasses.h"

#include "pointfront/Store/NodeReader.h"
#include "pointfront/Style/ResolvedStyle.h"

#include <cstdint>
#include <memory>

namespace pointfront
{

/// The points of an item that have been drawn into the kept keys. While a view is refining these
/// are the first ones, at full size: those that still grow are drawn anew each time.
struct DrawnItem
{
  std::shared_ptr<const NodeColumns> node; ///< kept alive: an address is no identity otherwise
  const ResolvedStyle* style = nullptr;
  TechniquePasses passes;
  std::uint32_t base = 0; ///< index of the node's first point in the keys
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  SizeTerms size;
  bool refined = false; ///< from here on as PlanItem's
  bool unfinished = false;
  float closingRadius = 0.0f;
  float sparsestRadius = 0.0f;
  float itemRadiusScale = 1.0f;
  PointGrowth growth;
};

} // namespace pointfront
