#include "GlancedFile.h"

#include "COPCFile.h"
#include "LASFormat.h"
#include "LAZGlance.h"
#include "SourceFormats.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/InPlace/FirstLook.h"
#include "pointfront/Tiles/TileFormat.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// Its name ends as those of point files do. What else the user drags in is refused as no cloud,
/// and not read as text from end to end.
bool hasEndingOfPoints(const std::string& path)
{
  const std::string extension = loweredExtension(path);
  const std::vector<std::string> known = SourceFormats().extensions();
  return !extension.empty() &&
    std::find(known.begin(), known.end(), extension.substr(1)) != known.end();
}

} // namespace

bool GlancedFileFormat::isPointFile(const std::string& path)
{
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure) || COPCFormat().accepts(path))
  {
    return false;
  }
  return LASFormat().accepts(path) ||
    (hasEndingOfPoints(path) && !SourceFormats::isStore(path) &&
      SourceFormats().mayHoldPoints(path));
}

bool GlancedFileFormat::isFolderOfPoints(const std::string& path)
{
  return LAZGlanceFormat().accepts(path) && !TileFormat().accepts(path);
}

Result<std::shared_ptr<const StoredCloud>> GlancedFileFormat::open(const std::string& path) const
{
  if (LASFormat().accepts(path))
  {
    return glanceAtLAS(path, { path });
  }
  Result<std::unique_ptr<PointSource>> source = SourceFormats().open(path);
  return source ? firstLookAt(std::move(*source)) : source.error();
}

} // namespace pointfront
