#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace pointfront::test
{

/// Facts of a real file from its owners and two independent decoders (MANIFEST.md there).
struct RealFile
{
  const char* path; ///< under shared/data
  const char* format; ///< SourceDescription::format
  std::uint64_t points; ///< that can be read
  /// "class:points" of every class present, or "N kinds".
  const char* classes;
};

void PrintTo(const RealFile& file, std::ostream* out); ///< for GoogleTest's messages

extern const std::vector<RealFile> realLASFiles;
extern const std::vector<RealFile> realLAZFiles;

/// The absolute path of a file under shared/data.
std::string sharedData(const std::string& path);

} // namespace pointfront::test
