#include "DrawnFiles.h"

#include "CancelSignal.h"
#include "WholeFile.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <filesystem>

namespace pointfront
{

namespace
{
bool sameName(const std::string& one, const std::string& other)
{
  namespace fs = std::filesystem;
  return fs::absolute(one).lexically_normal() == fs::absolute(other).lexically_normal();
}

/// A cloud that does not open is told when it is drawn. Behind an address lies no file here.
std::vector<std::string> filesOf(const std::vector<std::string>& clouds)
{
  std::vector<std::string> files = clouds;
  for (const std::string& cloud : clouds)
  {
    if (isAddress(cloud))
    {
      continue;
    }
    if (const auto opened = StoredCloudFormats::ofProcess().open(cloud))
    {
      const std::vector<std::string> behind = (*opened)->files();
      files.insert(files.end(), behind.begin(), behind.end());
    }
  }
  return files;
}
} // namespace

Result<void> checkDrawnFiles(const std::vector<OutputTarget>& targets,
  const std::vector<std::string>& clouds, const std::vector<std::string>& others)
{
  std::vector<OutputTarget> written;
  bool some = false; // some files are there: only then the attributes that are read matter
  for (OutputTarget target : targets)
  {
    std::error_code notThere;
    some = some || std::filesystem::exists(target.path, notThere);
    target.replace = true;
    if (!target.path.empty())
    {
      written.push_back(std::move(target));
    }
  }
  std::vector<std::string> reads = some ? filesOf(clouds) : std::vector<std::string>();
  reads.insert(reads.end(), others.begin(), others.end());
  for (std::size_t i = 0; i < written.size(); ++i)
  {
    for (std::size_t before = 0; before < i; ++before)
    {
      if (sameName(written[i].path, written[before].path) ||
        sameFile(written[i].path, written[before].path))
      {
        return makeError(Error::Kind::BadArgument,
          written[i].path + ": is named for two different files; give another name");
      }
    }
    if (Result<void> free = checkOutputTarget(written[i], reads); !free)
    {
      return free;
    }
    // The file of this test goes in any case, also where a signal would end the process at once.
    const CancelSignal finishing(CancelSignal::Mode::Finish);
    if (Result<void> writable = checkWritable(written[i].path); !writable)
    {
      return writable;
    }
    if (CancelSignal::requested())
    {
      return makeError(Error::Kind::Cancelled, "stopped; nothing was written");
    }
  }
  return {};
}

} // namespace pointfront
