#include "LASFormat.h"

#include "LASFile.h"
#include "LASSource.h"
#include "LAZSource.h"

#include "pointfront/Disk/SmallFile.h"

#include <utility>

namespace pointfront
{
namespace
{
Result<std::unique_ptr<PointSource>> openMap(const std::string& path, MemoryMap map)
{
  Result<LASFile> file = LASFile::of(path, std::move(map));
  if (!file)
  {
    return file.error();
  }
  return file->header.compressed ? LAZSource::open(std::move(*file))
                                 : LASSource::open(std::move(*file));
}
} // namespace

bool LASFormat::accepts(const std::string& path) const
{
  return beginningOf(path, 4) == "LASF";
}

Result<std::unique_ptr<PointSource>> LASFormat::open(const std::string& path) const
{
  Result<MemoryMap> map = MemoryMap::open(path);
  return map ? openMap(path, std::move(*map)) : map.error();
}

Result<std::unique_ptr<PointSource>> LASFormat::openBytes(
  const std::string& path, const RawBytes& bytes)
{
  return openMap(path, MemoryMap::ofBytes(path, bytes.data.get(), bytes.size));
}

} // namespace pointfront
