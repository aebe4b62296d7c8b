#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A piece of a source that is wanted, and the memory that it goes to.
struct ByteRange
{
  std::uint64_t offset = 0;
  std::size_t size = 0;
  std::byte* target = nullptr;
};

/// The cost of reads from a source, as far as it is known. Who reads chooses by it how much to ask
/// for at once. The values of a disk are the defaults.
struct ReadCost
{
  double roundTripSeconds = 0.0; ///< from a request to its first byte
  double bytesPerSecond = 0.0; ///< rate of all requests together; 0: faster than who reads
  unsigned readsAtOnce = 1; ///< more than that at a time are slower in total
  std::size_t bytesAtOnce = 0; ///< that one read should ask for if so much is wanted; 0: any

  /// Not on a disk here: each read costs a round trip, and several at once cost no more than one.
  bool far() const { return roundTripSeconds > 0.0 || readsAtOnce > 1; }
};

/// Set by who does not want the bytes any more; looked at by the source that reads them.
using ReadStop = std::atomic<bool>;

/// The parts of a source that its reader needs in any case. A far source fetches them together with
/// its size: they then cost no round trip of their own.
struct FirstBytes
{
  std::size_t head = 0; ///< from the first byte on
  std::size_t tail = 0; ///< up to the last byte
};

/// Bytes at given places: a file on a disk, or behind an address. Whatever reads a file of points
/// piece by piece reads it through this interface, and does not know where it lies.
/// Identity  the bytes stay those of one file. If somebody replaces a far file while it is open,
/// all
///           later reads give an error; bytes of two files never come together.
/// Threads   all functions from any thread: there is no shared cursor.
/// Errors    NotFound; Unreadable: the disk, the system or the server refuses or has changed the
///           file; Truncated: the source ends before what was asked for; Cancelled.
class ByteSource
{
public:
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// The path, or the address without what is secret in it (public form). It stands in messages,
  /// and openBytes() opens the source again by it.
  const std::string& path() const { return path_; }
  std::uint64_t bytes() const { return bytes_; } ///< when it was opened
  /// The number of the disk (file system) or of the server: equal for sources that share one.
  virtual std::uint64_t device() const = 0;
  virtual ReadCost cost() const { return {}; }
  /// Whether a read of that range is answered from memory, of a part that its owner holds there.
  virtual bool holds(std::uint64_t, std::size_t) const { return false; }

  /// Reads all ranges, in any order, together where that is faster. After an error the targets may
  /// be filled in part.
  virtual Result<void> read(const ByteRange* ranges, std::size_t count) const = 0;
  /// As read(), but a source that can give up in the middle does so with Cancelled soon after
  /// `stop` is set, from any thread. Others finish.
  virtual Result<void> readUntil(
    const ReadStop& stop, const ByteRange* ranges, std::size_t count) const;
  Result<void> readAt(std::uint64_t offset, std::byte* target, std::size_t size) const;
  Result<RawBytes> readAt(std::uint64_t offset, std::size_t size) const;

  /// True while another process has the file open under an exclusive lock: a running build replaces
  /// or keeps it. Also true on file systems that have no locks.
  virtual bool isLocked() const { return false; }
  /// False once another file has this path, or none.
  virtual bool isStillNamed() const { return true; }

protected:
  ByteSource(std::string path, std::uint64_t bytes);

private:
  std::string path_;
  std::uint64_t bytes_;
};

/// Opens the file at a path, or what is behind an address ("https://...") if an opener for its
/// scheme is known (ByteOpeners.h).
/// Errors  Unsupported: an address of a scheme that this process does not open.
Result<std::shared_ptr<const ByteSource>> openBytes(
  const std::string& path, const FirstBytes& first = {});

/// False, too, for a source that cannot be read.
bool beginsWith(const std::string& path, const void* bytes, std::size_t size);

} // namespace pointfront
