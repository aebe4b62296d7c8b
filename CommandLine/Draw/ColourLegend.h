#pragma once

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/ResolvedStyle.h"

#include <nlohmann/json_fwd.hpp>

namespace pointfront
{

/// Says how a style colours a store: "attribute", and with it "range" and "colours" from
/// its low to its high end, or "values", [value, colour] of whole numbers, each of its own colour.
/// Colours are "#rrggbb". Null where values are colours themselves, or there is one for all.
nlohmann::ordered_json colourLegend(const StoreDescription& store, const ResolvedStyle& style);

} // namespace pointfront
