#pragma once

#include "LASPointLayout.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Compresses LAS records through LASzip: to the end of an OutputFile in chunks of 50,000 points
/// with a chunk table behind them, or one chunk in memory. Header and records are the caller's.
/// Threads   one thread.
class LASzipWriter
{
public:
  enum class Chunks
  {
    Fixed,
    Variable ///< the chunk table says how many points each has
  };

  /// `layout` outlives the writer.
  static Result<LASzipWriter> create(
    const LASPointLayout& layout, const std::string& path, Chunks chunks = Chunks::Fixed);

  LASzipWriter(LASzipWriter&&) noexcept;
  LASzipWriter& operator=(LASzipWriter&&) noexcept;
  ~LASzipWriter();

  /// The record that tells readers how to decompress: belongs in front of the points.
  Result<MetadataRecord> compressionRecord() const;
  /// Points begin at `offset`, which is the end of `file` now. `file` outlives the writer.
  Result<void> begin(OutputFile& file, std::uint64_t offset);
  Result<void> append(const std::byte* records, std::size_t count);
  /// Writes the chunk table; gives the byte behind it.
  Result<std::uint64_t> finish();

  /// Instead of begin() and finish(), of variable chunks: all points become one chunk, whose bytes
  /// finishChunk() gives.
  Result<void> beginChunk();
  Result<std::vector<std::byte>> finishChunk();

private:
  struct Handle;
  explicit LASzipWriter(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> handle_;
};

} // namespace pointfront
