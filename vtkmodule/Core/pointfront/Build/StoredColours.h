#pragma once

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Ingest/PointIngest.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Trees/BlockSorter.h"

#include <optional>

namespace pointfront
{

/// The depth of a store's colours, known once all points are read.
struct StoredColours
{
  AttributeSchema schema; ///< the common schema as it is stored
  std::optional<ColourWidening> widening; ///< widening of records, while they are loaded
};

/// Whether the 16-bit colours of a source hold 8 bits.
bool hasNarrowColours(const std::vector<std::unique_ptr<PointSource>>& sources,
  const IngestedPoints& points, std::size_t source);

/// 16-bit colours become 8-bit if all fit; if only those of some files do, these are widened.
/// `wideElsewhere`: sources that are not here have 16 bits, so all are widened.
/// Error  BadArgument when 8 bits are asked for and a colour needs more, with the file.
Result<StoredColours> storedColours(const std::vector<std::unique_ptr<PointSource>>& sources,
  const CommonSchema& common, const RecordColumns& columns, const IngestedPoints& points,
  ColourDepth depth, bool wideElsewhere = false);

} // namespace pointfront
