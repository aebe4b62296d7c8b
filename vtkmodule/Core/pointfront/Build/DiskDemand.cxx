#include "pointfront/Build/DiskDemand.h"

#include <cerrno>
#include <sys/stat.h>
#include <sys/statvfs.h>

namespace pointfront
{
namespace
{
/// Stores of airborne and terrestrial surveys take a fifth to a half of their raw records.
constexpr std::uint64_t leastShareOfRecords = 6;

const char advice[] = "; free some space, choose another folder for temporary files (--temp), "
                      "allow more memory (--memory) so that less is spilled, or write to "
                      "another disk";

std::string needsText(const DiskDemand& demand)
{
  std::string text = "the store needs at least " + mebibytes(demand.storeBytes) + " in '" +
    demand.outputFolder + "'";
  if (demand.spillBytes > 0)
  {
    text += " and the points that do not fit in memory need " + mebibytes(demand.spillBytes) +
      " in '" + demand.spillFolder + "'";
  }
  return text;
}

Error tooLittle(const DiskDemand& demand, const std::string& folder, std::uint64_t available)
{
  return makeError(Error::Kind::Unwritable,
    "not enough disk space: " + needsText(demand) + ", but only " + mebibytes(available) +
      " are free in '" + folder + "'" + advice);
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

std::uint64_t leastStoreBytes(std::uint64_t points, std::size_t recordBytes)
{
  return points * recordBytes / leastShareOfRecords;
}

Result<void> checkDiskSpace(
  const DiskDemand& demand, const std::function<DiskSpace(const std::string&)>& spaceOf)
{
  const DiskSpace output = spaceOf(demand.outputFolder);
  if (demand.spillBytes == 0)
  {
    return output.freeBytes < demand.storeBytes
      ? Result<void>(tooLittle(demand, demand.outputFolder, output.freeBytes))
      : Result<void>();
  }
  const DiskSpace spill = spaceOf(demand.spillFolder);
  const bool shared = spill.device == output.device;
  const std::uint64_t inSpill = demand.spillBytes + (shared ? demand.storeBytes : 0);
  if (spill.freeBytes < inSpill)
  {
    return tooLittle(demand, demand.spillFolder, spill.freeBytes);
  }
  if (!shared && output.freeBytes < demand.storeBytes)
  {
    return tooLittle(demand, demand.outputFolder, output.freeBytes);
  }
  return {};
}

Error withDemand(Error error, const DiskDemand& demand)
{
  if (error.kind == Error::Kind::Unwritable)
  {
    error.what += " (" + needsText(demand) + ")";
  }
  return error;
}

} // namespace pointfront
