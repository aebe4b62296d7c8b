#include "pointfront/Collection/CollectionWriter.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Collection/CollectionState.h"
#include "pointfront/Collection/TileNames.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Tiles/CollectionCloud.h"

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace pointfront
{
namespace
{
/// A state to begin with, and the file that the next one goes to. As long as the file is there
/// nobody else begins.
struct Begun
{
  std::string path; ///< the file itself, where a link was named
  std::unique_ptr<OutputFile> file;
  std::shared_ptr<const PointStore> heads;
  std::optional<CollectionRecord> record; ///< there is one
};

Result<Begun> begin(const std::string& name)
{
  const std::string path = followedLink(name);
  if (isAddress(path))
  {
    return makeError(Error::Kind::Unsupported,
      path + ": a collection behind an address cannot be changed; change a file and upload that");
  }
  Begun begun;
  begun.path = path;
  if (!PointStore::looksLikeCollection(path)) // before a file is made beside what is none
  {
    const auto there = PointStore::openHeads(path);
    return there ? makeError(Error::Kind::BadFormat, "'" + path + "' is no collection")
                 : there.error();
  }
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path);
  if (!file)
  {
    return file.error();
  }
  begun.file = std::move(*file);
  // Now nobody else replaces it.
  Result<std::shared_ptr<const PointStore>> heads = PointStore::openHeads(path);
  if (!heads)
  {
    return heads.error();
  }
  begun.heads = std::move(*heads);
  Result<CollectionRecord> record = CollectionCloud::recordOf(*begun.heads);
  if (!record)
  {
    return record.error();
  }
  begun.record = std::move(*record);
  return begun;
}

std::string counted(const char* verb, std::size_t tiles)
{
  return std::string(verb) + " " + std::to_string(tiles) + (tiles == 1 ? " tile" : " tiles");
}

std::vector<const TileName*> tilesWithout(
  const std::unordered_set<std::uint32_t>& removed, const CollectionRecord& record)
{
  std::vector<const TileName*> kept;
  for (const CollectedTile& tile : record.tiles)
  {
    if (removed.count(tile.is.id) == 0)
    {
      kept.push_back(&tile.is);
    }
  }
  return kept;
}

/// The coordinate reference system that the tiles which stay name; empty: none does.
std::string systemWithout(
  const std::unordered_set<std::uint32_t>& removed, const CollectionRecord& record)
{
  std::set<std::uint32_t> kinds;
  for (const CollectedTile& tile : record.tiles)
  {
    removed.count(tile.is.id) == 0 ? void(kinds.insert(tile.kind)) : void();
  }
  for (const std::uint32_t kind : kinds)
  {
    if (std::string system = projectionOf(record.kinds[kind]); !system.empty())
    {
      return system;
    }
  }
  return {};
}

struct Change
{
  std::vector<TileName> removed;
  std::vector<TileRequest> requests;
  std::string what;
  bool undoes = false;
};

/// In the history of the next state, which will give its next numbers to the tiles that come.
void remember(const Change& change, std::size_t added, CollectionRecord& next)
{
  if (change.undoes)
  {
    next.history.pop_back();
    return;
  }
  CollectionChange entry{ change.what, {}, change.removed };
  for (std::size_t i = 0; i < added; ++i)
  {
    entry.added.push_back(next.nextId + static_cast<std::uint32_t>(i));
  }
  next.history.push_back(std::move(entry));
}

Result<CollectionReport> apply(Begun begun, Change change, const CollectionOptions& options)
{
  const std::string path = begun.path;
  std::unordered_set<std::uint32_t> removed;
  for (const TileName& tile : change.removed)
  {
    removed.insert(tile.id);
  }
  const std::vector<const TileName*> kept = tilesWithout(removed, *begun.record);
  Result<OpenedTiles> taken = openTiles(path, change.requests, options.progress);
  if (!taken)
  {
    return taken.error();
  }
  const std::string left = taken->warning();
  if (!left.empty() && !change.removed.empty())
  {
    return makeError(Error::Kind::BadArgument,
      path + ": " + left +
        "; a tile that has no points any more is taken out: pointfront "
        "collection remove");
  }
  std::vector<IncomingTile>& added = taken->tiles;
  // Older programs took a file twice: their changes can be undone.
  const Result<std::string> apart =
    change.undoes ? Result<std::string>("") : filesApart(path, kept, change.requests, added);
  if (!apart)
  {
    return apart.error();
  }
  Result<void> fits = nameApart(path, kept, added);
  const std::string system = systemWithout(removed, *begun.record);
  fits = fits ? checkSystems(path, added, system, options.sameSystem) : fits;
  if (!fits)
  {
    return fits.error();
  }
  const std::size_t count = added.size();
  CollectionState state(path, begun.heads, std::move(begun.record));
  change.what = left.empty() ? change.what : counted("add", count);
  remember(change, count, state.record());
  if (Result<void> done = state.change(removed, std::move(added), options); !done)
  {
    return done.error();
  }
  Result<CollectionReport> report = state.write(std::move(begun.file));
  if (report)
  {
    report->added = count;
    report->removed = removed.size();
    apart->empty() ? void() : report->warnings.push_back(*apart);
    left.empty() ? void() : report->warnings.push_back(left + ".");
  }
  return report;
}

/// A tile that the collection knew: to be opened again, and to be what it was.
TileRequest again(const std::string& path, const TileName& tile)
{
  return { beside(path, tile.address), tile.name, tile.epoch, tile.id, tile.identity };
}
} // namespace

Result<CollectionReport> createCollection(
  const std::string& path, const std::vector<TileRequest>& tiles, const CollectionOptions& options)
{
  if (isAddress(path))
  {
    return makeError(Error::Kind::Unsupported,
      path + ": a collection is written to a file; upload that when it is done");
  }
  Result<void> sound = checkAddresses(path, tiles);
  sound = sound ? checkNames(path, tiles) : sound;
  const Result<std::string> apart = sound ? filesApart(path, {}, tiles, {}) : sound.error();
  if (!apart)
  {
    return apart.error();
  }
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path);
  if (!file)
  {
    return file.error();
  }
  Result<OpenedTiles> taken = openTiles(path, tiles, options.progress);
  if (!taken)
  {
    return taken.error();
  }
  std::vector<IncomingTile>& opened = taken->tiles;
  Result<void> fits = nameApart(path, {}, opened);
  fits = fits ? checkSystems(path, opened, "", options.sameSystem) : fits;
  if (!fits)
  {
    return fits.error();
  }
  const std::size_t count = opened.size();
  const std::string left = taken->warning();
  CollectionState state(path, nullptr, std::nullopt);
  if (Result<void> done = state.change({}, std::move(opened), options); !done)
  {
    return done.error();
  }
  Result<CollectionReport> report = state.write(std::move(*file));
  if (report)
  {
    report->added = count;
    apart->empty() ? void() : report->warnings.push_back(*apart);
    left.empty() ? void() : report->warnings.push_back(left + ".");
  }
  return report;
}

Result<CollectionReport> addTiles(const std::string& collection,
  const std::vector<TileRequest>& tiles, const CollectionOptions& options)
{
  if (Result<void> sound = checkAddresses(collection, tiles); !sound)
  {
    return sound.error();
  }
  Result<Begun> begun = begin(collection);
  const Result<void> named = begun ? checkNames(begun->path, tiles) : begun.error();
  return named
    ? apply(std::move(*begun), { {}, tiles, counted("add", tiles.size()), false }, options)
    : named.error();
}

Result<CollectionReport> replaceTiles(const std::string& collection,
  const std::vector<TileRequest>& tiles, const CollectionOptions& options)
{
  if (Result<void> sound = checkAddresses(collection, tiles); !sound)
  {
    return sound.error();
  }
  Result<Begun> begun = begin(collection);
  if (!begun)
  {
    return begun.error();
  }
  const std::string& path = begun->path;
  if (const Result<void> named = checkNames(path, tiles); !named)
  {
    return named.error();
  }
  Change change{ {}, tiles, counted("replace", tiles.size()), false };
  for (TileRequest& request : change.requests)
  {
    const std::string name = request.name.empty() ? tileNameOf(request.path) : request.name;
    const std::string address = relativeAddress(path, request.path);
    const auto& known = begun->record->tiles;
    const auto there = std::find_if(known.begin(), known.end(),
      [&](const CollectedTile& tile) { return tile.is.address == address; });
    const auto found = there != known.end() && request.name.empty()
      ? there
      : std::find_if(known.begin(), known.end(),
          [&](const CollectedTile& tile) { return tile.is.name == name; });
    if (found == known.end())
    {
      return makeError(Error::Kind::NotFound,
        path + ": has no tile '" + name +
          "' that this one could replace; name that tile with --name, or take it in as another: "
          "pointfront collection add");
    }
    if (there != known.end() && there != found)
    {
      return makeError(Error::Kind::BadArgument,
        path + ": '" + request.path + "' is the tile '" + there->is.name +
          "', which cannot replace the tile '" + name + "' as well; remove one of them first");
    }
    request.name = found->is.name;
    request.epoch = request.epoch.empty() ? found->is.epoch : request.epoch;
    const std::uint32_t id = found->is.id;
    if (std::any_of(change.removed.begin(), change.removed.end(),
          [id](const TileName& tile) { return tile.id == id; }))
    {
      return makeError(Error::Kind::BadArgument,
        path + ": two files would replace the tile '" + found->is.name + "'");
    }
    change.removed.push_back(found->is);
  }
  return apply(std::move(*begun), std::move(change), options);
}

Result<CollectionReport> removeTiles(const std::string& collection,
  const std::vector<std::string>& names, const CollectionOptions& options)
{
  Result<Begun> begun = begin(collection);
  if (!begun)
  {
    return begun.error();
  }
  const std::string& path = begun->path;
  Change change{ {}, {}, "", false };
  std::unordered_map<std::string, const TileName*> known;
  known.reserve(2 * begun->record->tiles.size());
  for (const CollectedTile& tile : begun->record->tiles)
  {
    known.emplace(tile.is.address, &tile.is);
  }
  for (const CollectedTile& tile : begun->record->tiles)
  {
    known[tile.is.name] = &tile.is;
  }
  std::set<std::uint32_t> ids;
  for (const std::string& name : names)
  {
    auto found = known.find(name);
    found = found == known.end() ? known.find(relativeAddress(path, name)) : found;
    if (found == known.end())
    {
      return makeError(Error::Kind::NotFound,
        path + ": has no tile '" + name + "'; pointfront collection list names those it has");
    }
    if (ids.insert(found->second->id).second)
    {
      change.removed.push_back(*found->second);
    }
  }
  change.what = counted("remove", change.removed.size());
  return apply(std::move(*begun), std::move(change), options);
}

Result<CollectionReport> undoCollection(
  const std::string& collection, const CollectionOptions& options)
{
  Result<Begun> begun = begin(collection);
  if (!begun)
  {
    return begun.error();
  }
  const std::string& path = begun->path;
  if (begun->record->history.empty())
  {
    return makeError(Error::Kind::BadArgument,
      path + ": there is nothing to undo: it is as it was created, or as compact left it");
  }
  const CollectionChange& last = begun->record->history.back();
  Change change{ {}, {}, "", true };
  for (const CollectedTile& tile : begun->record->tiles)
  {
    if (std::find(last.added.begin(), last.added.end(), tile.is.id) != last.added.end())
    {
      change.removed.push_back(tile.is);
    }
  }
  for (const TileName& tile : last.removed)
  {
    change.requests.push_back(again(path, tile));
  }
  return apply(std::move(*begun), std::move(change), options);
}

Result<CollectionReport> compactCollection(
  const std::string& collection, const CollectionOptions& options)
{
  Result<Begun> begun = begin(collection);
  if (!begun)
  {
    return begun.error();
  }
  const std::string& path = begun->path;
  std::vector<TileRequest> requests;
  for (const CollectedTile& tile : begun->record->tiles)
  {
    requests.push_back(again(path, tile.is));
  }
  Result<OpenedTiles> opened = openTiles(path, requests, options.progress);
  if (!opened)
  {
    return opened.error();
  }
  CollectionState state(path, nullptr, std::nullopt);
  state.record().state = begun->record->state;
  state.record().nextId = begun->record->nextId;
  if (Result<void> done = state.change({}, std::move(opened->tiles), options); !done)
  {
    return done.error();
  }
  return state.write(std::move(begun->file));
}

} // namespace pointfront
