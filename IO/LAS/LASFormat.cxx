#include "LASFormat.h"

#include "LASFile.h"
#include "LASSource.h"
#include "LAZSource.h"

#include <cstring>
#include <fstream>
#include <utility>

namespace pointfront
{

bool LASFormat::accepts(const std::string& path) const
{
  char signature[4] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(signature, sizeof signature) && std::memcmp(signature, "LASF", 4) == 0;
}

Result<std::unique_ptr<PointSource>> LASFormat::open(const std::string& path) const
{
  Result<LASFile> file = LASFile::open(path);
  if (!file)
  {
    return file.error();
  }
  if (file->header.compressed)
  {
    return LAZSource::open(std::move(*file));
  }
  return LASSource::open(std::move(*file));
}

} // namespace pointfront
