#include "pointfront/Tiles/StoredCloudFormats.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Tiles/CollectionCloud.h"
#include "pointfront/Tiles/TileFormat.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <utility>

namespace pointfront
{
namespace
{
const char* const indexExtension = ".pfindex"; // `pointfront index` adds it to a file's name

/// First bytes of a far file: all that most kinds need to tell which kind it is and to describe it,
/// 30 ms of a line of 100 Mbit/s.
constexpr FirstBytes firstOfFar{ std::size_t(64) << 10, std::size_t(256) << 10 };
/// The roots of a store lie before its tables, and the nodes below them before these.
constexpr FirstBytes firstOfStore{ firstOfFar.head, PointStore::lastBytes };

Error withoutEpochs(const std::string& cloud, const std::string& epoch)
{
  return makeError(Error::Kind::BadArgument,
    "'" + cloud + "' is no collection, and nothing else has epochs; leave out '" + epoch + "'");
}

bool isNamedAsStore(const std::string& address)
{
  const std::string name = address.substr(0, address.find_first_of("?#"));
  return std::filesystem::path(name).extension() == ".pfront";
}

class StoreFile final : public StoredCloudFormat
{
public:
  std::string name() const override { return "store"; }
  bool accepts(const std::string& path) const override { return PointStore::looksLikeStore(path); }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override
  {
    Result<std::shared_ptr<const PointStore>> store = PointStore::open(path);
    if (!store)
    {
      return store.error();
    }
    return std::shared_ptr<const StoredCloud>(std::move(*store));
  }
};
} // namespace

StoredCloudFormats& StoredCloudFormats::ofProcess()
{
  static auto* const formats = new StoredCloudFormats; // never deleted: static objects may use it
  return *formats;
}

StoredCloudFormats::StoredCloudFormats()
{
  formats_.push_back(std::make_shared<CollectionFormat>()); // before stores: it is one besides
  formats_.push_back(std::make_shared<StoreFile>());
  formats_.push_back(std::make_shared<TileFormat>());
}

void StoredCloudFormats::add(std::shared_ptr<const StoredCloudFormat> format)
{
  const std::unique_lock<std::shared_mutex> lock(mutex_);
  const auto same = std::find_if(formats_.begin(), formats_.end(),
    [&format](const auto& known) { return known->name() == format->name(); });
  if (same != formats_.end())
  {
    *same = std::move(format);
    return;
  }
  formats_.push_back(std::move(format));
}

std::shared_ptr<const StoredCloudFormat> StoredCloudFormats::formatOf(const std::string& path) const
{
  const std::shared_lock<std::shared_mutex> lock(mutex_);
  const auto found = std::find_if(formats_.begin(), formats_.end(),
    [&path](const auto& format) { return format->accepts(path); });
  return found == formats_.end() ? nullptr : *found;
}

bool StoredCloudFormats::accepts(const std::string& path) const
{
  return formatOf(path) != nullptr;
}

Result<std::shared_ptr<const ByteSource>> StoredCloudFormats::openFar(const std::string& address)
{
  return openBytes(address, isNamedAsStore(address) ? firstOfStore : firstOfFar);
}

Result<std::shared_ptr<const StoredCloud>> StoredCloudFormats::open(const std::string& path) const
{
  return openBy(&StoredCloudFormat::open, path);
}

Result<std::shared_ptr<const StoredCloud>> StoredCloudFormats::openWhole(
  const std::string& path) const
{
  return openBy(&StoredCloudFormat::openWhole, path);
}

Result<std::shared_ptr<const StoredCloud>> StoredCloudFormats::openBy(
  Open way, const std::string& path) const
{
  const EpochAddress asked = EpochAddress::of(path);
  if (const EpochAddress first = EpochAddress::of(asked.file); first.epoch)
  {
    return makeError(Error::Kind::BadArgument,
      "'" + first.file + "': its epoch is named twice, '" + *first.epoch + "' and '" +
        asked.epoch.value_or("") + "'; leave one out");
  }
  std::shared_ptr<const ByteSource> held; // a source that is open is the same for all
  if (isAddress(path))
  {
    Result<std::shared_ptr<const ByteSource>> source = openFar(asked.file);
    if (!source)
    {
      return source.error();
    }
    held = std::move(*source);
  }
  const std::shared_ptr<const StoredCloudFormat> format = formatOf(path);
  if (std::error_code failure; !format && asked.epoch &&
      (accepts(asked.file) || std::filesystem::exists(asked.file, failure)))
  {
    return withoutEpochs(asked.file, *asked.epoch);
  }
  if (!format && !held && std::filesystem::exists(path) && accepts(path + indexExtension))
  {
    return makeError(Error::Kind::BadFormat,
      "'" + path + "' is not a PointFront store; its index is there, name that: '" + path +
        indexExtension + "'");
  }
  if (std::error_code failure; !format && std::filesystem::is_directory(path, failure))
  {
    return makeError(Error::Kind::NotFound,
      path +
        ": the folder and those below it hold no stored cloud; names were looked for that end "
        "in .pfront, .pfindex, .copc.laz, and ept.json in the folder itself. Of point files "
        "'pointfront build' makes a store");
  }
  Result<std::shared_ptr<const StoredCloud>> cloud =
    format ? (*format.*way)(path) : StoreFile().open(path);
  // An address has all kinds behind it, and those without epochs do not look for one.
  const bool named = held && asked.epoch && !asked.epoch->empty();
  if (cloud && named && (*cloud)->description().epochs.empty())
  {
    return withoutEpochs((*cloud)->description().path, *asked.epoch);
  }
  if (!cloud && held && !held->isStillNamed())
  {
    // Whatever was made of a part that could not be read: this is why.
    return makeError(Error::Kind::Unreadable,
      "'" + path + "' has changed on its server while it was open; open it again");
  }
  return cloud;
}

} // namespace pointfront
