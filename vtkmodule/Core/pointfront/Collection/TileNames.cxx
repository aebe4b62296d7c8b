#include "pointfront/Collection/TileNames.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Base/PrintableText.h"
#include "pointfront/Disk/ByteOpeners.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace pointfront
{
namespace
{
/// One path, however it is written.
bool isOnePath(const std::string& one, const std::string& other)
{
  const auto normal = [](const std::string& path)
  {
    std::error_code failure;
    return std::filesystem::absolute(path, failure).lexically_normal();
  };
  return one == other || normal(one) == normal(other);
}
} // namespace

Result<void> checkNames(const std::string& path, const std::vector<TileRequest>& requests)
{
  const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  for (const TileRequest& request : requests)
  {
    // A tile without a name gets that of its file, which may hold a line break, too.
    const std::string called = request.name.empty() ? tileNameOf(request.path) : request.name;
    for (const std::string& name : { called, request.epoch })
    {
      if (std::any_of(name.begin(), name.end(), isControl))
      {
        return makeError(Error::Kind::BadArgument,
          path + ": '" + printableText(name) +
            "' has control characters, which no name of a tile or an epoch has" +
            (request.name.empty() && name == called ? "; rename its file" : ""));
      }
    }
    const std::string& epoch = request.epoch;
    if (!epoch.empty() && (epoch.front() == ' ' || epoch.back() == ' '))
    {
      return makeError(Error::Kind::BadArgument,
        path + ": the epoch '" + epoch + "' begins or ends with a blank, which nobody sees");
    }
  }
  return {};
}

Result<std::string> filesApart(const std::string& path, const std::vector<const TileName*>& kept,
  const std::vector<TileRequest>& requests, const std::vector<IncomingTile>& added)
{
  // One file has one content: to look for ten thousand files takes 20 ms, and seconds on a share.
  const auto contentOf = [](const TileIdentity& is)
  { return std::tuple(is.bytes, is.head, is.tail); };
  std::set<std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>> contents;
  for (const IncomingTile& tile : added)
  {
    contents.insert(contentOf(tile.is.identity));
  }
  FileNames files;
  std::unordered_map<std::string, const TileName*> tiles;
  for (const TileName* const tile : kept)
  {
    if (contents.count(contentOf(tile->identity)) > 0)
    {
      const std::string file = beside(path, tile->address);
      files.add(file);
      tiles.emplace(file, tile);
    }
  }
  std::string first;
  std::size_t linked = 0;
  for (const TileRequest& request : requests)
  {
    const std::optional<std::string> before = files.add(request.path);
    if (before && isOnePath(*before, request.path))
    {
      const auto known = tiles.find(*before);
      return makeError(Error::Kind::BadArgument,
        path +
          (known == tiles.end()
              ? ": '" + *before + "' and '" + request.path + "' are one file; name it once"
              : ": has the file '" + request.path + "' already, as the tile '" +
                known->second->name +
                "'; put a new one in its place with: pointfront collection replace"));
    }
    linked += before ? 1 : 0;
    first = before && first.empty() ? "'" + *before + "' and '" + request.path + "'" : first;
  }
  const std::string more =
    linked > 1 ? " (and " + std::to_string(linked - 1) + " more such names)" : "";
  return linked == 0
    ? std::string()
    : first + " are one file by a link" + more + "; its points count as often as it is named";
}

Result<void> nameApart(const std::string& path, const std::vector<const TileName*>& kept,
  std::vector<IncomingTile>& added)
{
  std::unordered_set<std::string> names;
  std::unordered_set<std::string> addresses;
  names.reserve(kept.size());
  addresses.reserve(kept.size());
  for (const TileName* const tile : kept)
  {
    names.insert(tile->name);
    addresses.insert(tile->address);
  }
  for (IncomingTile& tile : added)
  {
    if (!addresses.insert(tile.is.address).second)
    {
      return makeError(Error::Kind::BadArgument,
        path + ": has the tile '" + tile.is.address +
          "' already; take a new file of it in with: pointfront collection replace");
    }
    if (!names.insert(tile.is.name).second)
    {
      tile.is.name = tile.named ? tile.is.name : tile.is.address;
      if (!names.insert(tile.is.name).second)
      {
        return makeError(
          Error::Kind::BadArgument, path + ": has a tile of the name '" + tile.is.name + "'");
      }
    }
  }
  return {};
}

} // namespace pointfront
