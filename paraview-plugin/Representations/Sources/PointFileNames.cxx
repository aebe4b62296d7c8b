#include "PointFileNames.h"

#include "SourceFormats.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace pointfront
{
namespace
{

std::string extensionOf(const std::string& name)
{
  const std::string extension = pointfront::loweredExtension(name);
  return extension.empty() ? extension : extension.substr(1);
}

/// Whether a PLY file has faces: then it is a surface, and ParaView's reader is the one for it.
bool hasFaces(const std::string& name)
{
  std::ifstream file(name);
  std::string line;
  constexpr int mostHeaderLines = 200;
  for (int i = 0; i < mostHeaderLines && std::getline(file, line); ++i)
  {
    if (line.rfind("element face ", 0) == 0)
    {
      return line.find_first_of("123456789") != std::string::npos;
    }
    if (line.rfind("end_header", 0) == 0)
    {
      break;
    }
  }
  return false;
}

/// FNV-1a, 32 bits: the same on every machine.
std::uint32_t checksumOf(const std::vector<std::string>& names)
{
  std::uint32_t sum = 2166136261u;
  for (const std::string& name : names)
  {
    for (const char c : name + '\n')
    {
      sum = (sum ^ static_cast<unsigned char>(c)) * 16777619u;
    }
  }
  return sum;
}

} // namespace

bool isPointFile(const std::string& name)
{
  const std::vector<std::string> known = SourceFormats().extensions();
  const std::string extension = extensionOf(name);
  const bool ours = std::find(known.begin(), known.end(), extension) != known.end();
  std::error_code missing;
  return ours && std::filesystem::is_regular_file(name, missing) &&
    !(extension == "ply" && hasFaces(name));
}

std::string storePathBeside(std::vector<std::string> names)
{
  std::sort(names.begin(), names.end());
  if (names.size() == 1)
  {
    return names.front() + ".pfront";
  }
  char sum[16];
  std::snprintf(sum, sizeof(sum), "%08x", static_cast<unsigned int>(checksumOf(names)));
  return names.front() + "-and-" + std::to_string(names.size() - 1) + "-more-" + sum + ".pfront";
}

} // namespace pointfront
