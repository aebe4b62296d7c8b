#include "RefusedFormat.h"

#include "pointfront/Disk/SmallFile.h"

#include <filesystem>

namespace pointfront
{

bool RefusedFormat::accepts(const std::string& path) const
{
  if (mark_.signature.empty())
  {
    return std::filesystem::path(path).filename() == mark_.fileName;
  }
  return beginningOf(path, mark_.signature.size()) == mark_.signature;
}

Result<std::unique_ptr<PointSource>> RefusedFormat::open(const std::string& path) const
{
  return makeError(Error::Kind::Unsupported, path + ": " + why_);
}

} // namespace pointfront
