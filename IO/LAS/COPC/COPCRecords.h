#pragma once

#include "COPCGrid.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/SpillFile.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// LAS records that come in any order and go in that of COPCGrid::key(), equal keys as they came.
/// More than memory holds: runs of them lie in one temporary file without a name, are sorted one by
/// one and then merged.
/// Memory   `memoryBytes` and a block of 1 MiB, but at least 4096 records; while runs are merged
///          `mergeBytes`, but at least a record of each run.
/// Errors   Unwritable: the folder takes no temporary file, its disk is full. Cancelled.
/// Threads  one thread.
class COPCRecords
{
public:
  struct Options
  {
    std::size_t recordBytes = 0;
    std::uint64_t memoryBytes = 0; ///< while records come and are sorted
    std::uint64_t mergeBytes = 0; ///< for all runs while they are merged
    std::string folder; ///< for the temporary file
    std::uint64_t expected = 0; ///< records that will come, at most; 0: not known
  };
  /// Told how many records are sorted; false cancels.
  using Advance = std::function<bool(std::uint64_t)>;
  struct Record
  {
    std::uint64_t key = 0;
    const std::byte* bytes = nullptr; ///< until the next call of next()
  };

  explicit COPCRecords(Options options);

  Result<void> append(const std::byte* records, std::size_t count);
  /// Nothing is appended after it.
  Result<void> sort(const COPCGrid& grid, const Advance& advance);
  /// The records in order; nothing: that was all.
  Result<std::optional<Record>> next();

  std::size_t runs() const { return runs_.size(); } ///< 0: all are in memory

private:
  struct Slot
  {
    std::uint64_t key;
    std::uint32_t index;
  };
  struct Run
  {
    std::uint64_t offset = 0; ///< in the file
    std::uint64_t points = 0;
    std::uint64_t read = 0; ///< points that came into `buffer`
    std::vector<std::byte> buffer;
    std::size_t at = 0; ///< byte in `buffer`
    std::uint64_t key = 0; ///< the record's there
  };

  Result<void> spill();
  Result<void> sortRun(Run& run, const COPCGrid& grid);
  void sortMemory(const COPCGrid& grid);
  /// Has the run's next record in its buffer. False: it has none.
  Result<bool> fill(Run& run);
  Result<void> push(std::size_t run);

  Options options_;
  std::size_t pointsInMemory_ = 0; ///< at most
  std::vector<std::byte> memory_;
  std::vector<Slot> order_;
  std::size_t nextInMemory_ = 0;
  std::unique_ptr<SpillFile> file_; ///< all runs lie in it
  std::uint64_t fileBytes_ = 0;
  std::vector<Run> runs_;
  std::vector<std::pair<std::uint64_t, std::size_t>> heap_; ///< keys and runs, the least in front
  std::optional<std::size_t> given_; ///< the run whose record is out
  const COPCGrid* grid_ = nullptr;
};

} // namespace pointfront
