#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A file that is whole or absent: written under another name, given its own name at the end.
/// Virtual, so that tests can have a disk that is full.
/// Cost     a durable file of some size goes past the page cache, where the system can do that.
/// Threads  one thread.
/// Errors   Unwritable, with the bytes that were missing when the disk is full.
class OutputFile
{
public:
  /// How durable publish() makes the file.
  enum class Durability
  {
    Full, ///< the disk has it
    None ///< nothing: for a file that means nothing after a crash
  };

  /// Creates a TemporaryFile of `path`. What is at `path` now will be replaced; what something else
  /// puts there before publish() is kept.
  static Result<std::unique_ptr<OutputFile>> create(
    const std::string& path, Durability durability = Durability::Full);

  /// Removes the file unless publish() was called.
  virtual ~OutputFile() = default;

  virtual const std::string& path() const = 0;
  /// The path of the file until publish().
  virtual const std::string& pathMeanwhile() const { return path(); }
  virtual Result<void> append(const std::byte* data, std::size_t size) = 0;
  /// Makes appended bytes readable from the file.
  virtual Result<void> settle() { return {}; }
  /// Overwrites bytes that were appended before.
  virtual Result<void> overwrite(std::uint64_t offset, const std::byte* data, std::size_t size) = 0;
  /// Renames to path(), and makes bytes and name as durable as asked for. Nothing may follow.
  /// Errors  Unwritable too if path() has come to be since create(): it is kept.
  virtual Result<void> publish() = 0;
};

} // namespace pointfront
