#pragma once

#include "pointfront/Points/PointSource.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Writes the points of an input to a file while they are read once, so that tiles need not decode
/// the input again. The file is a convenience: who finds none, or another one, reads the input.
/// Size     coded as a store's blocks are: at most 12 bytes a point if all coordinates are steps of
///          32 bits of the input's grid, else 24, and its attributes; usually a third of that.
/// Exact    what is read back has the bits of what was added.
/// Threads  add() from any.
class PointKeeper
{
public:
  /// Errors  Unwritable; also if another process keeps the same points now.
  static Result<std::shared_ptr<PointKeeper>> create(
    const std::string& path, const PointSource& source);
  /// Removes what was written unless finish() was called.
  ~PointKeeper();
  PointKeeper(const PointKeeper&) = delete;
  PointKeeper& operator=(const PointKeeper&) = delete;

  /// A chunk of the source. A full disk is no reason to end the reading: finish() tells it.
  void add(std::uint64_t chunk, const PointBatch& batch);
  /// Gives the file its name. `key`: tells this content from any other. The bytes of the file.
  /// Errors  Unwritable.
  Result<std::uint64_t> finish(const std::string& key);

private:
  struct Block
  {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0; ///< 0: not added
    std::uint64_t hash = 0;
  };
  PointKeeper(std::string path, const SourceDescription& description, std::uint64_t chunks);
  void write(std::uint64_t offset, const std::byte* data, std::size_t bytes);

  friend class KeptPoints;
  std::string path_;
  std::string meanwhile_;
  int descriptor_ = -1;
  AttributeSchema schema_;
  std::optional<QuantisationGrid> grid_;
  std::vector<Block> blocks_; // by chunk; each thread has its own
  std::atomic<std::uint64_t> end_{ 0 };
  std::atomic<int> fault_{ 0 }; ///< errno of the first write that failed
};

/// The source, whose points the keeper gets as they are read.
std::unique_ptr<PointSource> keeping(
  std::unique_ptr<PointSource> source, std::shared_ptr<PointKeeper> keeper);

/// The source, whose points come from the file at `path` if a keeper wrote it with this key for
/// such a source; where a chunk of the file is absent or damaged, from the source itself.
std::unique_ptr<PointSource> fromKept(
  std::unique_ptr<PointSource> source, const std::string& path, const std::string& key);

} // namespace pointfront
