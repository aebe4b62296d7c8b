#include "SinkFormats.h"

#include "COPCWriter.h"
#include "KnownSystems.h"
#include "KnownWords.h"
#include "LASWriter.h"
#include "PCDWriter.h"
#include "PLYWriter.h"
#include "XYZWriter.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Export/EightBitColourSink.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pointfront
{

namespace
{
const std::string assumeOption = "--assume-crs"; // an option of the build

std::string checkExtension(std::string& path)
{
  const CLI::Validator check = knownWords({ ".las", ".laz", ".xyz", ".csv", ".ply", ".pcd" });
  std::string extension = loweredExtension(path);
  return check(extension);
}
} // namespace

namespace
{
std::unique_ptr<PointSink> makeFile(const std::string& path, const SinkChoice& choice)
{
  const std::string extension = loweredExtension(path);
  if (extension == ".xyz" || extension == ".csv")
  {
    return std::make_unique<XYZWriter>(
      path, extension == ".csv" ? XYZWriter::Style::CSV : XYZWriter::Style::Blanks);
  }
  if (extension == ".ply")
  {
    return std::make_unique<PLYWriter>(path);
  }
  if (extension == ".pcd")
  {
    return std::make_unique<PCDWriter>(path,
      choice.doubleCoordinates ? PCDWriter::Coordinates::Float64 : PCDWriter::Coordinates::Float32);
  }
  if (isCOPCName(path))
  {
    COPCWriter::Options options;
    options.memoryBytes = choice.memoryBytes;
    options.readBytes = choice.readBytes;
    options.temporaryFolder = choice.temporaryFolder;
    options.created = choice.dated ? LASDate::today() : LASDate();
    options.progress = choice.progress;
    options.assumedCrsName = assumeOption;
    return std::make_unique<COPCWriter>(path, std::move(options));
  }
  return std::make_unique<LASWriter>(path,
    extension == ".laz" ? LASWriter::Encoding::Laz : LASWriter::Encoding::Las,
    choice.dated ? LASDate::today() : LASDate());
}
} // namespace

std::uint64_t usualCOPCMemoryBytes()
{
  return COPCWriter::Options::usualMemoryBytes;
}

Result<std::unique_ptr<PointSink>> makeSink(const std::string& path, const SinkChoice& choice)
{
  std::unique_ptr<PointSink> file = makeFile(path, choice);
  const FileKind kind = sinkKind(path);
  const unsigned usual = kind == FileKind::PLY || kind == FileKind::PCD ? 8 : 16;
  if (choice.colourBits.value_or(usual) == 8)
  {
    file = std::make_unique<EightBitColourSink>(std::move(file));
  }
  return choice.crs.empty() ? Result<std::unique_ptr<PointSink>>(std::move(file))
                            : sinkInSystem(std::move(file), choice.crs, assumeOption);
}

bool isCOPCName(const std::string& path)
{
  const std::filesystem::path name(path);
  return loweredExtension(path) == ".laz" && loweredExtension(name.stem().string()) == ".copc";
}

FileKind sinkKind(const std::string& path)
{
  if (isCOPCName(path))
  {
    return FileKind::COPC;
  }
  const std::string extension = loweredExtension(path);
  return extension == ".xyz" || extension == ".csv" ? FileKind::Text
    : extension == ".ply"                           ? FileKind::PLY
    : extension == ".pcd"                           ? FileKind::PCD
                                                    : FileKind::LAS;
}

CLI::Validator sinkExtension()
{
  return CLI::Validator(checkExtension, "OUT.las|.laz|.copc.laz|.xyz|.csv|.ply|.pcd");
}

} // namespace pointfront
