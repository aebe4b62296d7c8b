#include "pointfront/Disk/DiskEstimate.h"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <sys/stat.h>
#include <sys/statvfs.h>

namespace pointfront
{
namespace
{
/// Stores of airborne and terrestrial surveys take a fifth to a half of their raw records.
constexpr std::uint64_t leastShareOfRecords = 6;
constexpr std::uint64_t likelyShareOfRecords = 2;
/// The upper nodes of any store have fewer points: a thousand nodes or so of 16,384.
constexpr std::uint64_t mostLatePoints = std::uint64_t(1) << 24;

const char advice[] = "; free some space, choose another folder for temporary files (--temp), "
                      "allow more memory (--memory) so that less is spilled, or write to "
                      "another disk";

std::string needsText(const DiskEstimate& estimate)
{
  std::string text = "the store needs at least " + mebibytes(estimate.storeBytes) + ", perhaps " +
    mebibytes(estimate.likelyStoreBytes + estimate.lateBytes) + ", in '" + estimate.outputFolder +
    "'";
  if (estimate.spillBytes > 0)
  {
    text += " and the points that do not fit in memory need " + mebibytes(estimate.spillBytes) +
      " in '" + estimate.spillFolder + "'";
  }
  return text;
}

/// A folder whose disk has too little.
struct Shortage
{
  std::string folder;
  std::uint64_t freeBytes;
};

/// Where `storeBytes` and the spill do not fit. On one disk they need their sum.
std::optional<Shortage> shortageOf(const DiskEstimate& estimate, std::uint64_t storeBytes,
  const std::function<DiskSpace(const std::string&)>& spaceOf)
{
  const DiskSpace output = spaceOf(estimate.outputFolder);
  if (estimate.spillBytes > 0)
  {
    const DiskSpace spill = spaceOf(estimate.spillFolder);
    const bool shared = spill.device == output.device;
    if (spill.freeBytes < estimate.spillBytes + (shared ? storeBytes : 0))
    {
      return Shortage{ estimate.spillFolder, spill.freeBytes };
    }
    if (shared)
    {
      return std::nullopt;
    }
  }
  if (output.freeBytes < storeBytes)
  {
    return Shortage{ estimate.outputFolder, output.freeBytes };
  }
  return std::nullopt;
}

std::string shortageText(const DiskEstimate& estimate, const Shortage& shortage)
{
  return needsText(estimate) + ", but only " + mebibytes(shortage.freeBytes) + " are free in '" +
    shortage.folder + "'" + advice;
}
} // namespace

std::string mebibytes(std::uint64_t bytes)
{
  return std::to_string((bytes >> 20) + ((bytes & 0xfffff) != 0 ? 1 : 0)) + " MiB";
}

bool isDiskFault(int systemError)
{
  return systemError == ENOSPC || systemError == EDQUOT || systemError == EFBIG ||
    systemError == EIO;
}

DiskSpace diskSpaceOf(const std::string& folder)
{
  DiskSpace space;
  space.freeBytes = UINT64_MAX;
  struct stat place = {};
  struct statvfs disk = {};
  if (stat(folder.c_str(), &place) == 0 && statvfs(folder.c_str(), &disk) == 0)
  {
    space.device = place.st_dev;
    space.freeBytes = std::uint64_t(disk.f_bavail) * disk.f_frsize;
  }
  return space;
}

void estimateStore(DiskEstimate& estimate, std::uint64_t points, std::size_t recordBytes)
{
  estimate.storeBytes = points * recordBytes / leastShareOfRecords;
  estimate.likelyStoreBytes = points * recordBytes / likelyShareOfRecords;
  estimate.lateBytes = std::min(points, mostLatePoints) * recordBytes / likelyShareOfRecords;
}

Result<void> checkDiskSpace(
  const DiskEstimate& estimate, const std::function<DiskSpace(const std::string&)>& spaceOf)
{
  if (const auto shortage = shortageOf(estimate, estimate.storeBytes, spaceOf))
  {
    return makeError(
      Error::Kind::Unwritable, "not enough disk space: " + shortageText(estimate, *shortage));
  }
  return {};
}

std::string diskSpaceWarning(
  const DiskEstimate& estimate, const std::function<DiskSpace(const std::string&)>& spaceOf)
{
  const auto shortage =
    shortageOf(estimate, estimate.likelyStoreBytes + estimate.lateBytes, spaceOf);
  return shortage ? "Disk space may not suffice: " + shortageText(estimate, *shortage) + "." : "";
}

Error withEstimate(Error error, const DiskEstimate& estimate)
{
  if (error.kind == Error::Kind::Unwritable)
  {
    error.what += " (" + needsText(estimate) + ")";
  }
  return error;
}

} // namespace pointfront
