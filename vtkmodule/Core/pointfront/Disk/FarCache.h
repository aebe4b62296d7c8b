#pragma once

#include "pointfront/Base/Result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace pointfront
{
struct FarSettings;

/// Which far file, and which of its states.
struct FarIdentity
{
  std::string place; ///< where it is, without what is secret in its address
  std::uint64_t bytes = 0;
  std::string tag; ///< as its server names the state; a weak one ("W/...") says little
  std::string date; ///< when it changed last, as the server writes it
  /// Until then its server promises this state, in seconds since 1970; 0: it promises nothing. No
  /// part of the text.
  std::int64_t lastsUntil = 0;

  /// Whether another state would have another identity.
  bool tells() const { return (!tag.empty() && tag.front() == '"') || !date.empty(); }
  std::string text() const; ///< all of it, a line each
  FarIdentity withoutPromise() const;
};

/// A cache on this machine's disk: later programs need not ask servers for the same bytes again.
/// Identity  a part of the name of what is kept: of a file that was replaced nothing is used.
/// Bounded   what was not used for the longest time goes first.
/// Safety    see FarSegment. What cannot be kept is not kept, and nobody hears of it.
/// Secrets   none: neither query, user nor password. The folders that it makes are the user's
/// alone;
///           one that was there keeps its mode.
/// Choice    POINTFRONT_CACHE: its folder, or "off"; by itself "pointfront" in XDG_CACHE_HOME or
///           ~/.cache. POINTFRONT_CACHE_SIZE: bytes, also as "512M", "4G"; by itself 4 GiB, but at
///           most a tenth of the free space. POINTFRONT_OFFLINE=1: no server is asked.
/// Threads   any, and several processes.
class FarCache
{
public:
  /// Null if it is switched off, or its folder cannot be had.
  /// Errors  BadArgument: a POINTFRONT_CACHE_SIZE that is no size.
  static Result<std::shared_ptr<const FarCache>> ofProcess();
  static bool offline();
  /// As ofProcess(), with what the settings of an address say. One folder with one limit is one.
  /// Errors  Unwritable: a folder that the settings name, and that cannot be had.
  static Result<std::shared_ptr<const FarCache>> of(const FarSettings& settings);

  FarCache(std::string folder, std::uint64_t mostBytes);

  bool read(
    const FarIdentity& identity, std::uint64_t offset, std::size_t size, std::byte* target) const;
  /// Those blocks of the bytes that are whole.
  void keep(const FarIdentity& identity, std::uint64_t offset, const std::byte* data,
    std::size_t size) const;

  /// The state that its server named last, for who is offline.
  void note(const FarIdentity& identity) const;
  std::optional<FarIdentity> last(const std::string& place) const;

  struct Report
  {
    std::string folder;
    std::uint64_t bytes = 0; ///< on the disk
    std::uint64_t mostBytes = 0;
    std::uint64_t segments = 0;
    std::uint64_t blocks = 0; ///< that verify() has read
    std::uint64_t damaged = 0; ///< segments that verify() has taken out
  };
  Report report() const;
  /// Compares every block with its checksum, and takes out what is damaged.
  Report verify() const;
  /// Takes out all that it has kept, and nothing else. Errors  Unwritable.
  Result<void> clear() const;
  /// Takes out what was not used for long, until the limit holds.
  void tidy() const;

private:
  std::string segmentPath(const FarIdentity& identity, std::uint64_t segment) const;

  const std::string folder_;
  const std::uint64_t mostBytes_;
  mutable std::atomic<std::uint64_t> untidied_; ///< bytes written since tidy()
  mutable std::atomic<bool> full_{ false }; ///< the disk has refused
};

} // namespace pointfront
