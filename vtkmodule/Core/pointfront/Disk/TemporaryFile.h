#pragma once

#include "pointfront/Base/Result.h"

#include <string>

namespace pointfront
{

/// A file in the making, beside the one that it becomes. Its name is that of the other, its inode
/// number and a random number, and ".tmp": no file of a user has such a name and that inode number.
struct TemporaryFile
{
  std::string path;
  int descriptor = -1; ///< to read and write; locked, where the file system has locks
};

/// The folder that a path names a file in: "." if it names none.
std::string folderOf(const std::string& path);

/// Creates an empty file, and removes what processes that died left for the same `path` (their
/// locks died with them). File systems without locks (some network shares) have no such removal.
/// Errors  Unwritable: the folder takes no file, or another process is writing `path` now.
Result<TemporaryFile> createTemporaryFile(const std::string& path);

/// Removes them. False if a living process is writing `path`.
bool removeLeftOvers(const std::string& path);

/// Gives the file `temporary` its name. `replace`: what has that name is replaced.
/// Errors  Unwritable, and `temporary` is still there: something has that name and stays, or the
///         operating system refuses.
Result<void> nameTemporaryFile(const std::string& temporary, const std::string& path, bool replace);

} // namespace pointfront
