#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// The payload of a node lies in two pieces: the first has the positions and the columns that
/// pictures mostly want, the second all other columns. Writers put the first pieces of many nodes
/// side by side, so who draws a store from afar loads little else.
constexpr std::size_t payloadPieces = 2;

/// The piece of each column of a schema: 0 the first, 1 the second.
using ColumnPieces = std::vector<std::uint8_t>;

/// The choice for stores that are written now; readers take it from the file. Names decide, without
/// regard to case: rgb, classification, normal and splat_radius are in the first, and intensity
/// where there is no rgb.
ColumnPieces chooseColumnPieces(const AttributeSchema& schema);

} // namespace pointfront
