#pragma once

#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/PointSource.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace pointfront
{

/// A random share of the points that were read so far, kept by source and chunk.
/// Choice   random steps through a chunk, seeded by its number: the same points whichever thread
///          reads it when; never equidistant ones, which would show scan patterns (EWA-3).
/// Threads  all functions from any thread.
class PointSample
{
public:
  /// Keeps about `share` (0 to 1) of a chunk, instead of what was kept of it before.
  void keep(std::size_t source, std::uint64_t chunk, const SourceDescription& description,
    const PointBatch& batch, double share);
  void clear();

  std::uint64_t points() const;
  /// The kept points as one source for each original (`metadata` is added to theirs). Later
  /// calls of keep() do not change it.
  PointSources snapshot(const PointSources& originals, const MetadataRecord& metadata) const;

private:
  using ChunkKey = std::pair<std::size_t, std::uint64_t>; // source, chunk
  mutable std::mutex mutex_; // guards what follows
  std::map<ChunkKey, std::shared_ptr<const PointBatch>> kept_;
  std::uint64_t points_ = 0;
};

} // namespace pointfront
