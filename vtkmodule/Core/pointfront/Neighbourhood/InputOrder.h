#pragma once

#include "pointfront/Points/AttributePass.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// A chunk of one of several sources.
struct SourceChunk
{
  std::size_t source = 0;
  std::uint64_t chunk = 0; ///< number of the chunk in that source
};

/// Numbers the points of several sources in input order: by source, chunk, position in the chunk.
/// Threads  immutable.
class InputOrder
{
public:
  explicit InputOrder(const PointSources& sources)
  {
    for (const auto& source : sources)
    {
      sourceBegin_.push_back(chunkBegin_.size());
      for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
      {
        chunkBegin_.push_back(points_);
        points_ += source->chunkPoints(chunk);
        largestChunk_ = std::max(largestChunk_, source->chunkPoints(chunk));
      }
    }
  }

  std::uint64_t points() const { return points_; }
  std::uint64_t largestChunk() const { return largestChunk_; } ///< points
  std::uint64_t chunks() const { return chunkBegin_.size(); } ///< chunks of all sources
  SourceChunk chunk(std::uint64_t number) const
  {
    // Sources without a chunk begin where the next one does: the last that begins here owns it.
    const auto after = std::upper_bound(sourceBegin_.begin(), sourceBegin_.end(), number);
    const auto source = static_cast<std::size_t>(after - sourceBegin_.begin() - 1);
    return { source, number - sourceBegin_[source] };
  }
  /// Number of the first point of a chunk.
  std::uint64_t first(const SourceChunk& chunk) const
  {
    return chunkBegin_[sourceBegin_[chunk.source] + chunk.chunk];
  }

private:
  std::vector<std::uint64_t> sourceBegin_; // number of each source's first chunk
  std::vector<std::uint64_t> chunkBegin_;
  std::uint64_t points_ = 0;
  std::uint64_t largestChunk_ = 0;
};

} // namespace pointfront
