#pragma once

#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Records/TreeSpace.h"
#include "pointfront/Trees/BlockSorter.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pointfront
{

/// How points become records of the pool.
struct RecordForm
{
  const CommonSchema& common;
  const RecordColumns& columns;
  const TreeSpace& space; ///< with its origin
};

/// The points of a sample as the records that they are once they are loaded from the pool: with
/// positions relative to the root, colours of the sources marked in `widened` widened.
/// `sample`: one source for each that the build reads; what cannot be read of it, or contradicts
/// the columns left out, is left out.
std::vector<std::byte> sampleRecords(const PointSources& sample, const RecordForm& form,
  const std::optional<ColourWidening>& widening, const std::vector<bool>& widened);

} // namespace pointfront
