#include "pointfront/Base/FileNames.h"

#include <filesystem>

#include <sys/stat.h>

namespace pointfront
{

std::string followedLink(const std::string& path)
{
  std::error_code failure;
  if (!std::filesystem::is_symlink(path, failure))
  {
    return path;
  }
  const std::filesystem::path target = std::filesystem::canonical(path, failure);
  return failure ? path : target.string();
}

std::optional<std::string> FileNames::add(const std::string& path)
{
  const auto firstOf = [&path](auto& names, const auto& key)
  {
    const auto [at, added] = names.emplace(key, path);
    return added ? std::nullopt : std::optional<std::string>(at->second);
  };
  struct stat state = {};
  return ::stat(path.c_str(), &state) == 0 ? firstOf(files_, std::pair(state.st_dev, state.st_ino))
                                           : firstOf(others_, path);
}

} // namespace pointfront
