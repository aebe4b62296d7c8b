#pragma once

#include "Conversation.h"

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/FarCache.h"
#include "pointfront/Threads/OfProcess.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace pointfront
{

/// A file behind an address, read by ranges.
/// Opening   the head and the tail that the reader needs come in one round trip, with the size.
/// Reads     ranges are sorted; neighbours become one request where the bytes between them cost
/// less
///           than a request more, and all requests are on their way at once. A small read brings
///           the block around it, which is kept.
/// Identity  length and ETag (or the date of the last change) of the first answer hold for all
///           later ones. Another one is an error, for this read and all later ones.
/// Retries   passing refusals (429, 5xx), resets, stalls and short bodies, with growing pauses, as
///           long as the patience of a read allows (ReadPatience).
/// Cache     what came is kept on the disk (FarCache), in blocks of 4 KiB. Opening asks the server
///           nevertheless whether the file is still the same, unless the server has promised it
///           (AnswerHeaders.h); offline, nothing is asked.
/// Memory    head and tail, and 4 MiB of blocks.
/// Fork      a child reads on, over connections of its own.
/// Errors    those of ByteSource. Messages name the public form of the address alone.
class RemoteSource final : public ByteSource
{
public:
  /// The cache on this machine's disk, and whether it is all that may be asked.
  struct Local
  {
    std::shared_ptr<const FarCache> cache; ///< may be null
    bool offline = false; ///< no server is asked
  };
  static Result<std::shared_ptr<const RemoteSource>> open(
    std::unique_ptr<const Conversation> conversation, const FirstBytes& first, Local local);

  std::uint64_t device() const override;
  ReadCost cost() const override;
  Result<void> read(const ByteRange* ranges, std::size_t count) const override;
  /// The cache keeps those bytes that have come when `stop` is set.
  Result<void> readUntil(
    const ReadStop& stop, const ByteRange* ranges, std::size_t count) const override;
  /// False once a read has found another file at the address.
  bool isStillNamed() const override { return !changed_; }

private:
  using Interval64 = std::pair<std::uint64_t, std::uint64_t>;

  /// Small reads brought these.
  struct Blocks
  {
    std::mutex mutex; ///< guards all that follows
    std::map<std::uint64_t, WantedBytes> byOffset;
    std::vector<std::uint64_t> order; ///< their offsets, the oldest first
  };

  RemoteSource(
    std::unique_ptr<const Conversation> conversation, RemoteIdentity identity, Local local);
  static Result<std::shared_ptr<const RemoteSource>> openOffline(
    std::unique_ptr<const Conversation> conversation, Local local);
  static std::shared_ptr<const RemoteSource> openAsKept(
    std::unique_ptr<const Conversation> conversation, const FarIdentity& last, Local local);
  /// Asks the server for those ranges. `needed`: what a request should have of each.
  Result<void> ask(const std::vector<const ByteRange*>& missing,
    const std::vector<Interval64>& needed, const ReadStop& stop) const;
  void keepOnDisk(const WantedBytes& piece) const;
  Blocks& blocks() const;
  bool takeHeld(const ByteRange& range) const;
  Interval64 withoutEnds(Interval64 needed) const;
  void keepBlocks(const WantedBytes& piece, const Interval64& needed) const;

  const std::unique_ptr<const Conversation> conversation_;
  const RemoteIdentity identity_;
  const std::shared_ptr<const FarCache> cache_; ///< may be null
  const bool offline_;
  const FarIdentity kept_; ///< the same identity, in the cache
  std::vector<WantedBytes> ends_; ///< head and tail, or the whole file
  mutable std::atomic<bool> changed_{ false }; ///< somebody has replaced the file
  mutable OfProcess<Blocks> blocks_;
};

} // namespace pointfront
