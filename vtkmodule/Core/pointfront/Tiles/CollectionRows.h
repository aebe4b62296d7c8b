#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Tiles/CollectionTiles.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace pointfront
{

/// The things that a collection's table waits for: tiles that are to be opened, and pages of open
/// ones. Order    tiles first, the one that was asked for first before others. Faults   fault()
/// tells of a tile that cannot be opened; takeFaults() does not, because who reads
///          the rest of its root is told then.
/// Threads  all functions from any thread.
class CollectionRows final : public MissingRows
{
public:
  explicit CollectionRows(std::shared_ptr<const CollectionTiles> tiles);

  /// A row of a closed tile is wanted.
  RowState ask(std::size_t tile);
  /// The same state: an open tile's table gave it.
  RowState asked(RowState state);
  /// Opens a tile now, unless it is open.
  Result<const CollectionTiles::Tile*> open(std::size_t tile);

  bool waiting() const override;
  std::size_t readNext() override;
  void attach(const void* reader, std::function<void()> wanted) override;
  void detach(const void* reader) override;

  std::uint64_t arrivals() const;
  bool wait(std::uint64_t seen, std::chrono::steady_clock::time_point end);
  std::optional<Error> fault() const;
  std::vector<Error> takeFaults() const;

private:
  using Table = std::shared_ptr<const Hierarchy>;
  std::vector<Table> openTables() const;
  std::optional<std::size_t> nextWanted();
  std::function<void()> teller(const std::function<void()>& wanted);

  const std::shared_ptr<const CollectionTiles> tiles_;
  mutable std::atomic<bool> pagesWanted_{ false }; ///< some open table may wait
  std::atomic<bool> tilesWanted_{ false }; ///< !wanted_.empty(); written under the lock
  std::atomic<std::uint64_t> opened_{ 0 }; ///< openings that have ended, well or not

  mutable std::mutex mutex_; ///< guards what follows
  std::condition_variable changed_;
  std::vector<std::size_t> wanted_; ///< the oldest first
  std::vector<bool> told_; ///< by tile: wanted, or its opening has ended
  std::vector<bool> ended_; ///< by tile: its opening has ended
  std::size_t opening_ = 0;
  std::vector<Table> tables_; ///< those of open tiles
  std::map<const void*, std::function<void()>> readers_;
  std::optional<Error> firstFault_;
};

} // namespace pointfront
