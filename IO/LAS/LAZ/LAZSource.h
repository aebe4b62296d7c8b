#pragma once

#include "LASFile.h"
#include "LAZChunkTable.h"
#include "LAZCompression.h"

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// The points of a LAZ or COPC file. A chunk is a run of the file's own chunks with about 65,536
/// points together, or a single larger one: nothing is ever decompressed twice.
/// Threads   read() makes a decompressor of its own; any number of threads.
/// Errors    of open(): those of LAZCompression::of and findLAZChunks, Unsupported for chunks of
///           more than lazMostChunkPoints. Of read(): BadFormat with the damaged chunk's byte.
class LAZSource final : public PointSource
{
public:
  static Result<std::unique_ptr<PointSource>> open(LASFile file);

  const SourceDescription& description() const override { return file_.description; }
  std::uint64_t chunkCount() const override { return runs_.size(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override;
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override;

private:
  /// How positions are given.
  enum class Positions
  {
    World,
    Steps
  };
  /// Some of the file's chunks, one behind the other.
  struct Run
  {
    std::size_t first = 0;
    std::size_t end = 0;
    std::uint64_t points = 0;
  };

  LAZSource(LASFile file, LAZCompression compression, std::vector<LAZChunk> chunks);
  Result<void> decompress(std::uint64_t chunk, PointBatch& batch, Positions positions) const;
  /// Appends the points of one chunk to `batch`.
  Result<void> decompress(const LAZChunk& chunk, PointBatch& batch, Positions positions) const;

  LASFile file_;
  LAZCompression compression_;
  std::vector<LAZChunk> chunks_;
  std::vector<Run> runs_;
};

} // namespace pointfront
