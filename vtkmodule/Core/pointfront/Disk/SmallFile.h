#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// The content of a regular file, or of what lies behind an address (openBytes), that is small by
/// its nature: a description, a page of a hierarchy.
/// Errors  NotFound; Unreadable: no regular file (a folder, a pipe), or no permission; BadFormat:
///         more than `most` bytes, which no such file has; Truncated: it became shorter meanwhile.
Result<RawBytes> readSmallFile(const std::string& path, std::uint64_t most);
Result<std::string> readSmallText(const std::string& path, std::uint64_t most);

/// A file and the most bytes that it may have.
struct SmallFile
{
  std::string path;
  std::uint64_t most = 0;
};
/// Several: those behind addresses beside each other, so that they take the round trips of one. The
/// answers are in the order of `files`; Cancelled where `stop` was set before a file was begun.
std::vector<Result<RawBytes>> readSmallFiles(
  const std::vector<SmallFile>& files, const ReadStop& stop);

/// The first bytes of such a file, fewer if it has fewer; none if it cannot be read. Never waits
/// for the other end of a pipe.
std::string beginningOf(const std::string& path, std::size_t bytes);

} // namespace pointfront
