#include "InputIdentity.h"

#include "MosaicFiles.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Disk/ByteOpeners.h"

#include <filesystem>
#include <set>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

std::string timeOf(const fs::path& path)
{
  std::error_code failure;
  const auto time = fs::last_write_time(path, failure);
  return failure ? "" : std::to_string(time.time_since_epoch().count());
}

/// A tree of node files: their sizes and times.
std::string identityOfTree(const fs::path& folder)
{
  std::set<std::string> entries;
  std::error_code failure;
  for (fs::recursive_directory_iterator at(folder, failure), end; !failure && at != end;
       at.increment(failure))
  {
    if (at->is_regular_file(failure))
    {
      entries.insert(at->path().string() + " " + std::to_string(at->file_size(failure)) + " " +
        timeOf(at->path()));
    }
  }
  std::uint64_t hash = 0;
  for (const std::string& entry : entries)
  {
    hash = hashOfText(entry, hash);
  }
  return hex(hash);
}

} // namespace

std::uint64_t hashOfText(const std::string& text, std::uint64_t seed)
{
  return contentHash(reinterpret_cast<const std::byte*>(text.data()), text.size(), seed);
}

Result<std::string> identityOfFile(const std::string& path)
{
  std::error_code failure;
  if (!isAddress(path) && fs::is_directory(path, failure))
  {
    return identityOfTree(path);
  }
  if (!isAddress(path) && fs::path(path).filename() == "ept.json")
  {
    return identityOfTree(fs::path(path).parent_path());
  }
  const Result<TileIdentity> ends = TileIdentity::of(path);
  return ends ? Result<std::string>(toJson(*ends).dump() + timeOf(path))
              : Result<std::string>(ends.error());
}

Result<std::string> identityOfInput(const SourceDescription& description)
{
  Result<std::string> all = identityOfFile(description.path);
  for (const std::string& further : description.furtherFiles)
  {
    const Result<std::string> more = all ? identityOfFile(further) : all;
    all = more ? Result<std::string>(*all + " " + *more) : more;
  }
  return all;
}

std::string kindOf(const SourceDescription& description)
{
  nlohmann::json kind;
  for (const Attribute& attribute : description.schema)
  {
    kind.push_back({ attribute.name, static_cast<int>(attribute.type), attribute.components,
      attribute.scale, attribute.offset });
  }
  if (description.grid)
  {
    const QuantisationGrid& grid = *description.grid;
    kind.push_back(
      { grid.scale.x, grid.scale.y, grid.scale.z, grid.offset.x, grid.offset.y, grid.offset.z });
  }
  kind.push_back({ description.crsWkt, description.splatRadiusBase, description.deepColours });
  std::uint64_t hash =
    hashOfText(kind.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
  for (const MetadataRecord& record : description.metadata)
  {
    hash = hashOfText(record.owner + std::to_string(record.id), hash);
    hash = contentHash(record.payload.data(), record.payload.size(), hash);
  }
  return hex(hash);
}

} // namespace pointfront
