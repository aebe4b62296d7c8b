#include "GlancedFile.h"

#include "COPCFile.h"
#include "LASFormat.h"
#include "LAZGlance.h"

#include <filesystem>

namespace pointfront
{

bool GlancedFileFormat::isPointFile(const std::string& path)
{
  std::error_code failure;
  return std::filesystem::is_regular_file(path, failure) && LASFormat().accepts(path) &&
    !COPCFormat().accepts(path);
}

Result<std::shared_ptr<const StoredCloud>> GlancedFileFormat::open(const std::string& path) const
{
  return glanceAtLAS(path, { path });
}

} // namespace pointfront
