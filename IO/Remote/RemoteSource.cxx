#include "RemoteSource.h"

#include "TransferLoop.h"

#include "pointfront/Disk/FarSegment.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t leastHead = 4096;
constexpr std::uint64_t smallRead = 4096; ///< up to here a read brings its whole block
constexpr std::uint64_t blockBytes = 16384;
constexpr std::uint64_t keptBytes = FarSegment::blockBytes;
constexpr std::size_t mostBlocks = 256;
constexpr std::uint64_t largestPiece = std::uint64_t(4) << 20;
constexpr double leastGap = 4096.0;
constexpr double largestGap = 65536.0;

/// Bytes that may lie between two ranges of one request: as many as come in the time that one more
/// request costs beside others.
std::uint64_t gapOf(const ReadCost& cost)
{
  const double bytes = static_cast<double>(cost.bytesAtOnce) / std::max(1u, cost.readsAtOnce);
  return static_cast<std::uint64_t>(std::clamp(bytes, leastGap, largestGap));
}

/// The first byte, and the one behind the last.
using Interval = std::pair<std::uint64_t, std::uint64_t>;

/// kept: whole blocks of the cache on the disk.
Interval neededFor(const ByteRange& range, std::uint64_t fileBytes, bool kept)
{
  Interval needed{ range.offset, range.offset + range.size };
  const std::uint64_t step = range.size <= smallRead ? blockBytes : kept ? keptBytes : 1;
  needed.first = needed.first / step * step;
  needed.second = (needed.second + step - 1) / step * step;
  needed.second = std::min(needed.second, fileBytes);
  return needed;
}

/// Requests that cover all intervals.
std::vector<WantedBytes> requestsFor(std::vector<Interval> needed, std::uint64_t gap)
{
  std::sort(needed.begin(), needed.end(),
    [](const Interval& a, const Interval& b) { return a.first < b.first; });
  std::vector<Interval> merged;
  for (const Interval& one : needed)
  {
    if (!merged.empty() && one.first <= merged.back().second + gap)
    {
      merged.back().second = std::max(merged.back().second, one.second);
    }
    else
    {
      merged.push_back(one);
    }
  }
  std::vector<WantedBytes> requests;
  for (const Interval& one : merged)
  {
    const std::uint64_t size = one.second - one.first;
    const std::uint64_t parts = (size + largestPiece - 1) / largestPiece;
    for (std::uint64_t part = 0; part < parts; ++part)
    {
      WantedBytes wanted;
      wanted.offset = one.first + size * part / parts;
      wanted.size = one.first + size * (part + 1) / parts - wanted.offset;
      requests.push_back(std::move(wanted));
    }
  }
  return requests;
}

std::int64_t now()
{
  return std::chrono::duration_cast<std::chrono::seconds>(
    std::chrono::system_clock::now().time_since_epoch())
    .count();
}

std::int64_t lastsUntil(std::chrono::seconds unchanged)
{
  return unchanged.count() > 0 ? now() + unchanged.count() : 0;
}

bool isPromised(const FarIdentity& last)
{
  return now() < last.lastsUntil;
}

/// Copies what of [first, first + size) lies in the piece; `target` is for `first`.
void copyFrom(const WantedBytes& piece, std::uint64_t first, std::uint64_t size, std::byte* target)
{
  const std::uint64_t begin = std::max(first, piece.offset);
  const std::uint64_t end = std::min(first + size, piece.offset + piece.bytes.size());
  if (begin < end)
  {
    std::memcpy(target + (begin - first), piece.bytes.data() + (begin - piece.offset),
      static_cast<std::size_t>(end - begin));
  }
}

/// Leaves out the part of a block with which a piece begins. The cache keeps whole blocks only: a
/// node that lies there would be answered from memory, and be missing offline.
void cutToBlock(WantedBytes& piece)
{
  const std::uint64_t cut =
    std::min<std::uint64_t>((keptBytes - piece.offset % keptBytes) % keptBytes, piece.bytes.size());
  piece.bytes.erase(piece.bytes.begin(), piece.bytes.begin() + static_cast<std::ptrdiff_t>(cut));
  piece.offset += cut;
}

} // namespace

RemoteSource::RemoteSource(
  std::unique_ptr<const Conversation> conversation, RemoteIdentity identity, Local local)
  : ByteSource(conversation->name(), identity.bytes)
  , conversation_(std::move(conversation))
  , identity_(std::move(identity))
  , cache_(std::move(local.cache))
  , offline_(local.offline)
  , kept_{ conversation_->place(), identity_.bytes, identity_.tag, identity_.changed,
    lastsUntil(identity_.unchangedFor) }
{
}

std::uint64_t RemoteSource::device() const
{
  // No number of a file system has its highest bit.
  return std::hash<std::string>{}(conversation_->line()) | (std::uint64_t(1) << 63);
}

ReadCost RemoteSource::cost() const
{
  return TransferLoop::ofProcess().cost(conversation_->line());
}

Result<std::shared_ptr<const RemoteSource>> RemoteSource::open(
  std::unique_ptr<const Conversation> conversation, const FirstBytes& first, Local local)
{
  if (local.offline)
  {
    return openOffline(std::move(conversation), std::move(local));
  }
  const std::shared_ptr<const FarCache>& cache = local.cache;
  const std::optional<FarIdentity> last = cache ? cache->last(conversation->place()) : std::nullopt;
  if (last && isPromised(*last))
  {
    return openAsKept(std::move(conversation), *last, std::move(local));
  }
  // A file that was kept is asked only whether it is still the same.
  const bool known = last.has_value();
  // Whole blocks, so that they can be kept.
  std::vector<WantedBytes> ends(first.tail > 0 && !known ? 2 : 1);
  ends[0].size = known ? leastHead : std::max<std::uint64_t>(first.head, leastHead);
  ends[0].size = (ends[0].size + keptBytes - 1) / keptBytes * keptBytes;
  if (ends.size() > 1)
  {
    ends[1].size = first.tail + (cache ? keptBytes : 0);
    ends[1].tail = true;
  }
  const std::vector<WantedBytes> asked = ends;
  std::optional<RemoteIdentity> identity;
  const std::atomic<bool> cancelled{ false };
  Result<void> done = conversation->fetch(ends, identity, cancelled);
  if (!done && identity && identity->replaced)
  {
    // Head and tail are of two files: it was replaced just now, and the new one can be had.
    ends = asked;
    identity.reset();
    done = conversation->fetch(ends, identity, cancelled);
  }
  if (!done)
  {
    return done.error();
  }
  std::shared_ptr<RemoteSource> source(
    new RemoteSource(std::move(conversation), std::move(*identity), std::move(local)));
  source->ends_ = std::move(ends);
  if (source->cache_)
  {
    source->cache_->note(source->kept_);
  }
  for (WantedBytes& end : source->ends_)
  {
    if (source->cache_)
    {
      cutToBlock(end);
    }
    source->keepOnDisk(end);
  }
  return std::shared_ptr<const RemoteSource>(std::move(source));
}

/// As its server named it last.
Result<std::shared_ptr<const RemoteSource>> RemoteSource::openOffline(
  std::unique_ptr<const Conversation> conversation, Local local)
{
  const std::optional<FarIdentity> last =
    local.cache ? local.cache->last(conversation->place()) : std::nullopt;
  if (!last)
  {
    return makeError(Error::Kind::NotFound,
      "'" + conversation->name() + "' is not in the cache, and no server is asked (offline)");
  }
  return openAsKept(std::move(conversation), *last, std::move(local));
}

/// Without a question: what the cache lacks is asked for as bytes of that state.
std::shared_ptr<const RemoteSource> RemoteSource::openAsKept(
  std::unique_ptr<const Conversation> conversation, const FarIdentity& last, Local local)
{
  RemoteIdentity identity;
  identity.tag = last.tag;
  identity.changed = last.date;
  identity.bytes = last.bytes;
  return std::shared_ptr<const RemoteSource>(
    new RemoteSource(std::move(conversation), std::move(identity), std::move(local)));
}

void RemoteSource::keepOnDisk(const WantedBytes& piece) const
{
  if (cache_)
  {
    cache_->keep(kept_, piece.offset, piece.bytes.data(), piece.bytes.size());
  }
}

RemoteSource::Blocks& RemoteSource::blocks() const
{
  return blocks_.get([] { return std::make_unique<Blocks>(); });
}

/// From the ends of the file, or from a block of an earlier small read.
bool RemoteSource::takeHeld(const ByteRange& range) const
{
  for (const WantedBytes& end : ends_)
  {
    if (range.offset >= end.offset && range.offset + range.size <= end.offset + end.bytes.size())
    {
      copyFrom(end, range.offset, range.size, range.target);
      return true;
    }
  }
  if (range.size > smallRead)
  {
    return false;
  }
  Blocks& held = blocks();
  const std::lock_guard<std::mutex> lock(held.mutex);
  const Interval needed = neededFor(range, bytes(), cache_ != nullptr);
  for (std::uint64_t at = needed.first; at < needed.second; at += blockBytes)
  {
    if (held.byOffset.count(at) == 0)
    {
      return false;
    }
  }
  for (std::uint64_t at = needed.first; at < needed.second; at += blockBytes)
  {
    copyFrom(held.byOffset.at(at), range.offset, range.size, range.target);
  }
  return true;
}

/// The part of an interval that does not lie in the ends of the file, which are held.
RemoteSource::Interval64 RemoteSource::withoutEnds(Interval64 needed) const
{
  for (const WantedBytes& end : ends_)
  {
    const std::uint64_t last = end.offset + end.bytes.size();
    if (end.offset <= needed.first && last > needed.first && last < needed.second)
    {
      needed.first = std::max(needed.first, last / keptBytes * keptBytes); // whole blocks
    }
    else if (end.offset > needed.first && end.offset < needed.second && last >= needed.second)
    {
      needed.second = std::min(needed.second, (end.offset + keptBytes - 1) / keptBytes * keptBytes);
    }
  }
  return needed;
}

/// Blocks of small reads are kept: what is asked for next often lies beside.
void RemoteSource::keepBlocks(const WantedBytes& piece, const Interval64& needed) const
{
  Blocks& held = blocks();
  const std::lock_guard<std::mutex> lock(held.mutex);
  for (std::uint64_t at = needed.first; at < needed.second; at += blockBytes)
  {
    const std::uint64_t end = std::min(at + blockBytes, bytes());
    if (at < piece.offset || end > piece.offset + piece.bytes.size() || held.byOffset.count(at) > 0)
    {
      continue;
    }
    WantedBytes block;
    block.offset = at;
    block.size = end - at;
    block.bytes.resize(static_cast<std::size_t>(block.size));
    copyFrom(piece, at, block.size, block.bytes.data());
    held.byOffset.emplace(at, std::move(block));
    held.order.push_back(at);
    if (held.order.size() > mostBlocks)
    {
      held.byOffset.erase(held.order.front());
      held.order.erase(held.order.begin());
    }
  }
}

Result<void> RemoteSource::read(const ByteRange* ranges, std::size_t count) const
{
  return readUntil(ReadStop{ false }, ranges, count);
}

Result<void> RemoteSource::readUntil(
  const ReadStop& stop, const ByteRange* ranges, std::size_t count) const
{
  std::vector<const ByteRange*> missing;
  std::vector<Interval> needed;
  for (std::size_t i = 0; i < count; ++i)
  {
    const ByteRange& range = ranges[i];
    if (range.offset > bytes() || range.size > bytes() - range.offset)
    {
      return makeError(Error::Kind::Truncated,
        "'" + path() + "' ends at byte " + std::to_string(bytes()) + ", before byte " +
          std::to_string(range.offset + range.size) + " that it should have");
    }
    if (range.size > 0 && !takeHeld(range) &&
      !(cache_ && !changed_ && cache_->read(kept_, range.offset, range.size, range.target)))
    {
      missing.push_back(&range);
      const Interval all = neededFor(range, bytes(), cache_ != nullptr);
      needed.push_back(range.size > smallRead ? withoutEnds(all) : all);
    }
  }
  if (missing.empty())
  {
    return {};
  }
  if (changed_)
  {
    return makeError(Error::Kind::Unreadable,
      "'" + path() + "' has changed on its server while it was open; open it again");
  }
  if (offline_)
  {
    return makeError(Error::Kind::Unreadable,
      "'" + path() + "' is in the cache in part only, and no server is asked (offline)");
  }
  return ask(missing, needed, stop);
}

Result<void> RemoteSource::ask(const std::vector<const ByteRange*>& missing,
  const std::vector<Interval64>& needed, const ReadStop& stop) const
{
  std::vector<WantedBytes> pieces = requestsFor(needed, gapOf(cost()));
  std::optional<RemoteIdentity> identity = identity_;
  const Result<void> done = conversation_->fetch(pieces, identity, stop);
  if (!done && done.error().kind != Error::Kind::Cancelled)
  {
    changed_ = changed_ || (identity && identity->replaced);
    if (changed_ && cache_)
    {
      cache_->note(kept_.withoutPromise()); // it was not kept: who opens the file again asks
    }
    return done;
  }
  for (const WantedBytes& piece : pieces)
  {
    keepOnDisk(piece);
  }
  if (!done)
  {
    return done;
  }
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    for (const WantedBytes& end : ends_)
    {
      copyFrom(end, missing[i]->offset, missing[i]->size, missing[i]->target);
    }
    for (const WantedBytes& piece : pieces)
    {
      copyFrom(piece, missing[i]->offset, missing[i]->size, missing[i]->target);
      if (missing[i]->size <= smallRead)
      {
        keepBlocks(piece, needed[i]);
      }
    }
  }
  return {};
}

} // namespace pointfront
