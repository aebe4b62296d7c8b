#pragma once

#include <string>
#include <utility>

namespace pointfront
{

/// The reason why an operation on the outside world (file, disk, decoder, image) failed. Mistakes
/// of our own caller are asserts, never Errors.
struct Error
{
  enum class Kind
  {
    NotFound, ///< the file or folder is not there
    Unreadable, ///< it is there, and the operating system refuses to read it
    Unwritable, ///< cannot be created or written (permission, full disk)
    BadFormat, ///< the bytes contradict the format, or themselves
    Truncated, ///< the bytes end before what they promise
    Corrupt, ///< a checksum or an invariant of a store does not hold
    Unsupported, ///< well-formed, but of a kind or a version we do not read
    BadArgument, ///< the user's request cannot be done with this input
    NoMemory, ///< the memory limit is too small for the work
    Cancelled ///< the user asked to stop
  };

  Kind kind = Kind::BadFormat;
  /// The fault, where it is (path, byte offset, node), what to try. One line, no full stop needed.
  std::string what;
};

inline Error makeError(Error::Kind kind, std::string what)
{
  return Error{ kind, std::move(what) };
}

} // namespace pointfront
