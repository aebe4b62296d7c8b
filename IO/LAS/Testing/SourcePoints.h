#pragma once

#include "pointfront/Points/PointSource.h"

#include <map>
#include <string>

namespace pointfront::test
{

/// All points of a source in the order of their chunks, in one batch. A chunk that cannot be read
/// is a test failure.
PointBatch readAll(const PointSource& source);
/// The same, read by `threads` threads that take chunks from the last to the first.
PointBatch readAllBackwards(const PointSource& source, int threads);

/// Opens through LASFormat; a failure is a test failure and gives nullptr.
std::unique_ptr<PointSource> openOrFail(const std::string& path);

/// The values of one component of a column, as double before scale and offset.
std::vector<double> valuesOf(
  const PointBatch& batch, const AttributeSchema& schema, const char* name, int component = 0);

/// "class:points" of every class, ascending, one blank between.
std::string classHistogram(const PointBatch& batch, const AttributeSchema& schema);

} // namespace pointfront::test
