#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pointfront
{

/// Paths of the temporary files (TemporaryFile.h) of a file that is written at `path`.
inline std::vector<std::string> filesInTheMaking(const std::string& path)
{
  namespace fs = std::filesystem;
  const std::string start = fs::path(path).filename().string() + ".";
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(path).parent_path()))
  {
    const std::string name = entry.path().filename().string();
    if (name.compare(0, start.size(), start) == 0 && entry.path().extension() == ".tmp")
    {
      found.push_back(entry.path().string());
    }
  }
  return found;
}

} // namespace pointfront
