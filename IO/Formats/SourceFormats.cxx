#include "SourceFormats.h"

#include "CloudFormats.h"
#include "EPTFormat.h"
#include "LASFormat.h"
#include "PCDFormat.h"
#include "PLYFormat.h"
#include "RefusedFormat.h"
#include "StoreInputFormat.h"
#include "TextFormat.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Query/StoredPoints.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pointfront
{

namespace
{
/// A cloud that is read piece by piece, never as a whole file.
bool isReadByNodes(const std::string& path, bool boxed)
{
  if (isAddress(path) || std::filesystem::path(path).extension() == ".pfcollection" ||
    EpochAddress::of(path).epoch)
  {
    return true;
  }
  std::error_code failure;
  return boxed && std::filesystem::is_regular_file(path, failure) &&
    StoredCloudFormats::ofProcess().accepts(path);
}
} // namespace

SourceFormats::SourceFormats(const SourceOptions& options)
  : box_(options.box)
{
  if (box_)
  {
    addCloudFormats(); // those that have an index
  }
  formats_.push_back(std::make_unique<StoreInputFormat>());
  formats_.push_back(std::make_unique<LASFormat>());
  formats_.push_back(std::make_unique<PLYFormat>(options.survey));
  formats_.push_back(std::make_unique<PCDFormat>(options.survey, options.temporaryFolder));
  formats_.push_back(std::make_unique<RefusedFormat>("E57 (refused)",
    std::vector<std::string>{ "e57" }, RefusedFormat::Mark{ "ASTM-E57", "" },
    "E57 files are not read: no E57 library comes with the system; convert it to LAS, LAZ or PLY "
    "(with CloudCompare, or PDAL's readers.e57)"));
  formats_.push_back(std::make_unique<EPTFormat>(&LASFormat::openBytes, options.survey));
  // Last: any text with numbers in it is accepted.
  formats_.push_back(std::make_unique<TextFormat>(
    options.columns, options.survey, options.text, options.temporaryFolder));
}

std::vector<std::string> SourceFormats::extensions() const
{
  std::vector<std::string> all;
  for (const auto& format : formats_)
  {
    const std::vector<std::string> own = format->extensions();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

bool SourceFormats::isStore(const std::string& path)
{
  return StoreInputFormat().accepts(path);
}

bool SourceFormats::mayHoldPoints(const std::string& path) const
{
  if (PointStore::looksLikePreview(path))
  {
    return false;
  }
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".txt" && extension != ".csv" && extension != ".asc" && extension != ".tsv" &&
    extension != ".gz")
  {
    return true;
  }
  return std::any_of(formats_.begin(), formats_.end(),
    [&path](const std::unique_ptr<PointSourceFormat>& format) { return format->accepts(path); });
}

const PointSourceFormat* SourceFormats::named(const std::string& path) const
{
  const std::string extension = loweredExtension(path);
  for (const auto& format : formats_)
  {
    const std::vector<std::string> own = format->extensions();
    if (!extension.empty() && std::find(own.begin(), own.end(), extension.substr(1)) != own.end())
    {
      return format.get();
    }
  }
  return nullptr;
}

Result<std::unique_ptr<PointSource>> SourceFormats::open(const std::string& path) const
{
  Result<std::unique_ptr<PointSource>> source = openUncut(path);
  return source && box_ ? box_->cut(std::move(*source)) : std::move(source);
}

Result<std::unique_ptr<PointSource>> SourceFormats::openUncut(const std::string& path) const
{
  if (isReadByNodes(path, box_ != nullptr))
  {
    Result<std::shared_ptr<const StoredCloud>> cloud = StoredCloudFormats::ofProcess().open(path);
    return cloud ? StoredPoints::open(std::move(*cloud), box_ ? &box_->bounds() : nullptr)
                 : cloud.error();
  }
  std::error_code failure;
  if (!std::filesystem::exists(path, failure))
  {
    return makeError(Error::Kind::NotFound, path + ": no such file");
  }
  if (std::filesystem::is_regular_file(path, failure) &&
    std::filesystem::file_size(path, failure) == 0 && !failure)
  {
    return makeError(Error::Kind::BadFormat, path + ": the file is empty (0 bytes)");
  }
  const PointSourceFormat* const byName = named(path);
  const PointSourceFormat* const anyText = formats_.back().get();
  std::string known;
  for (const auto& format : formats_)
  {
    // A PCD file without its header is a broken PCD file, not text.
    const bool claimed = format.get() == anyText && byName != nullptr && byName != anyText;
    if (!claimed && format->accepts(path))
    {
      return format->open(path);
    }
    known += (known.empty() ? "" : ", ") + format->name();
  }
  if (byName != nullptr)
  {
    return byName->open(path);
  }
  return makeError(Error::Kind::Unsupported,
    path + ": not a point file of a family that is read here (" + known + ")");
}

} // namespace pointfront
