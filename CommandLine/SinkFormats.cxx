#include "SinkFormats.h"

#include "LASWriter.h"
#include "PCDWriter.h"
#include "PLYWriter.h"
#include "Unavailable.h"
#include "XYZWriter.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace pointfront
{

namespace
{
std::string extensionOf(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string checkExtension(std::string& path)
{
  const CLI::Validator check = availableValues({ ".las", ".laz", ".xyz", ".ply", ".pcd" }, {});
  std::string extension = extensionOf(path);
  return check(extension);
}
} // namespace

std::unique_ptr<PointSink> makeSink(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension == ".xyz")
  {
    return std::make_unique<XYZWriter>(path);
  }
  if (extension == ".ply")
  {
    return std::make_unique<PLYWriter>(path);
  }
  if (extension == ".pcd")
  {
    return std::make_unique<PCDWriter>(path);
  }
  return std::make_unique<LASWriter>(
    path, extension == ".laz" ? LASWriter::Encoding::Laz : LASWriter::Encoding::Las);
}

FileKind sinkKind(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".xyz" ? FileKind::Text
    : extension == ".ply"    ? FileKind::PLY
    : extension == ".pcd"    ? FileKind::PCD
                             : FileKind::LAS;
}

CLI::Validator sinkExtension()
{
  return CLI::Validator(checkExtension, "OUT.las|.laz|.xyz|.ply|.pcd");
}

} // namespace pointfront
