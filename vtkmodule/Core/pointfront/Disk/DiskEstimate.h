#pragma once

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <functional>
#include <string>

namespace pointfront
{

/// The disk of a folder: its number, and the bytes that an ordinary user may still write there.
struct DiskSpace
{
  std::uint64_t device = 0; ///< equal for folders on one disk
  std::uint64_t freeBytes = 0; ///< UINT64_MAX if the system does not tell
};

/// By stat and statvfs. A missing folder counts as having all space: opening it gives the error.
DiskSpace diskSpaceOf(const std::string& folder);

/// The bytes that a build will write, and their folders: known before the first point is read.
/// Units    bytes. The spill is exact; the store is estimated from both sides: a build is refused
///          only if it could hardly succeed, and a disk that may be too small is told of.
struct DiskEstimate
{
  std::string spillFolder;
  std::uint64_t spillBytes = 0; ///< 0: nothing is spilled
  std::string outputFolder;
  std::uint64_t storeBytes = 0; ///< the least that the store is expected to take
  std::uint64_t likelyStoreBytes = 0; ///< more than most stores take
  /// Nodes that the store gets last lie in a temporary file in its folder until then.
  std::uint64_t lateBytes = 0;
};

/// Fills in what a store of so many points takes. `recordBytes` is a point with all attributes,
/// uncompressed.
void estimateStore(DiskEstimate& estimate, std::uint64_t points, std::size_t recordBytes);

/// Unwritable when a disk has too little: how much is needed, where, what is free, what to do.
/// Spill and store that share a disk need their sum there.
Result<void> checkDiskSpace(const DiskEstimate& estimate,
  const std::function<DiskSpace(const std::string&)>& spaceOf = diskSpaceOf);

/// A sentence for the user when checkDiskSpace() has nothing to say, but the store might still not
/// fit; empty when all is well.
std::string diskSpaceWarning(const DiskEstimate& estimate,
  const std::function<DiskSpace(const std::string&)>& spaceOf = diskSpaceOf);

/// An Error of writing with what the build needs in all, when the disk was the reason.
Error withEstimate(Error error, const DiskEstimate& estimate);

/// ENOSPC, EDQUOT, EFBIG, EIO: what `errno` is when a disk, a quota, a limit or a device ends.
bool isDiskFault(int systemError);

/// "12 MiB", rounded up.
std::string mebibytes(std::uint64_t bytes);

} // namespace pointfront
