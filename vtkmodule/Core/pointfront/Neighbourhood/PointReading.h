#pragma once

#include "pointfront/Neighbourhood/PointTiles.h"

#include <atomic>

namespace pointfront
{

/// Reads all chunks of all sources once, by several threads, as points with their number in input
/// order and their class.
/// Threads  next() from any thread, each with a Chunk of its own.
class PointReading
{
public:
  struct Chunk
  {
    PointBatch batch;
    std::vector<TilePoint> points; ///< those that have a place and are of the classes wanted
    std::uint64_t read = 0; ///< all
  };

  PointReading(const PointSources& sources, const InputOrder& order, const ClassSet& classes);
  /// False when there are no more chunks. Errors: those of the sources; BadFormat: more points than
  /// announced.
  Result<bool> next(Chunk& chunk);

private:
  const PointSources& sources_;
  const InputOrder& order_;
  ClassSet classes_;
  std::atomic<std::uint64_t> next_{ 0 };
};

/// Gives `classes[i]` for the points of a batch: column "classification", 0 without one.
void readClasses(
  const AttributeSchema& schema, const PointBatch& batch, std::vector<std::uint8_t>& classes);

} // namespace pointfront
