#include "RefusedFormat.h"

#include <filesystem>
#include <fstream>

namespace pointfront
{

bool RefusedFormat::accepts(const std::string& path) const
{
  if (mark_.signature.empty())
  {
    return std::filesystem::path(path).filename() == mark_.fileName;
  }
  std::string start(mark_.signature.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) &&
    start == mark_.signature;
}

Result<std::unique_ptr<PointSource>> RefusedFormat::open(const std::string& path) const
{
  return makeError(Error::Kind::Unsupported, path + ": " + why_);
}

} // namespace pointfront
