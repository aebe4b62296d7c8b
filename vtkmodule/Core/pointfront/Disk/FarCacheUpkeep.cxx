#include "pointfront/Disk/FarCache.h"

#include "pointfront/Disk/FarSegment.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
constexpr std::size_t hashLength = 32;

struct KeptFile
{
  std::string path;
  std::uint64_t bytes = 0; ///< on the disk: holes take none
  ::timespec used{};
};

/// As FarCache names what it keeps: a hash, and the number of a segment or of a process.
bool isKept(const std::filesystem::path& path)
{
  const std::string name = path.filename().string();
  const std::size_t hash = name.find_first_not_of("0123456789abcdef");
  const std::size_t end = hash == std::string::npos ? name.size() : hash;
  const bool numbered = end + 1 < name.size() && (name[end] == '-' || name[end] == '.') &&
    name.find_first_not_of("0123456789", end + 1) == std::string::npos;
  return end == hashLength && (end == name.size() || numbered);
}

/// Those of the cache. The folder may have been there before, with files of its user. Others may
/// take out what is listed here.
std::vector<KeptFile> filesOf(const std::string& folder)
{
  std::vector<KeptFile> files;
  std::error_code failure;
  auto entry = std::filesystem::recursive_directory_iterator(
    folder, std::filesystem::directory_options::skip_permission_denied, failure);
  for (; !failure && entry != std::filesystem::recursive_directory_iterator();
       entry.increment(failure))
  {
    struct stat state
    {
    };
    if (isKept(entry->path()) && ::lstat(entry->path().c_str(), &state) == 0 &&
      S_ISREG(state.st_mode))
    {
      files.push_back(
        { entry->path().string(), std::uint64_t(state.st_blocks) * 512, state.st_mtim });
    }
  }
  return files;
}
} // namespace

FarCache::Report FarCache::report() const
{
  Report report;
  report.folder = folder_;
  report.mostBytes = mostBytes_;
  for (const KeptFile& file : filesOf(folder_ + "/segments"))
  {
    report.bytes += file.bytes;
    ++report.segments;
  }
  return report;
}

FarCache::Report FarCache::verify() const
{
  Report report;
  report.folder = folder_;
  report.mostBytes = mostBytes_;
  for (const KeptFile& file : filesOf(folder_ + "/segments"))
  {
    const FarSegment::Check check = FarSegment::check(file.path);
    report.blocks += check.blocks;
    std::error_code failure;
    if (check.sound)
    {
      report.bytes += file.bytes;
      ++report.segments;
    }
    else
    {
      ++report.damaged;
      std::filesystem::remove(file.path, failure);
    }
  }
  return report;
}

Result<void> FarCache::clear() const
{
  for (const char* const part : { "/segments", "/places" })
  {
    std::set<std::filesystem::path> folders{ folder_ + part };
    for (const KeptFile& file : filesOf(folder_ + part))
    {
      std::error_code failure;
      std::filesystem::remove(file.path, failure);
      if (failure)
      {
        return makeError(
          Error::Kind::Unwritable, file.path + ": cannot be removed: " + failure.message());
      }
      folders.insert(std::filesystem::path(file.path).parent_path());
    }
    // Those below first. What holds files of others stays.
    std::for_each(folders.rbegin(), folders.rend(),
      [](const std::filesystem::path& folder) { ::rmdir(folder.c_str()); });
  }
  return {};
}

void FarCache::tidy() const
{
  std::vector<KeptFile> files = filesOf(folder_ + "/segments");
  std::uint64_t total = 0;
  for (const KeptFile& file : files)
  {
    total += file.bytes;
  }
  if (total <= mostBytes_ - mostBytes_ / 8)
  {
    return;
  }
  std::sort(files.begin(), files.end(),
    [](const KeptFile& one, const KeptFile& other)
    {
      return one.used.tv_sec != other.used.tv_sec ? one.used.tv_sec < other.used.tv_sec
                                                  : one.used.tv_nsec < other.used.tv_nsec;
    });
  for (const KeptFile& file : files)
  {
    if (total <= mostBytes_ / 4 * 3)
    {
      return;
    }
    std::error_code failure;
    std::filesystem::remove(file.path, failure);
    total -= file.bytes;
  }
}

} // namespace pointfront
