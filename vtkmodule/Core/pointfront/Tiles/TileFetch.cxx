#include "pointfront/Tiles/TileFetch.h"

#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Threads/WaitingWork.h"

#include <sys/resource.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t tilesAtOnce = 16;

struct Group
{
  const StoredCloud* tile = nullptr;
  std::vector<WantedNode> nodes;
  std::vector<std::size_t> places; ///< in the whole list
};
} // namespace

std::vector<Result<FetchedNode>> fetchTiles(
  const std::vector<WantedOfTile>& wanted, const ReadStop& stop)
{
  std::vector<Group> groups;
  std::map<const StoredCloud*, std::size_t> numbers;
  bool far = false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    const auto [found, fresh] = numbers.emplace(wanted[i].tile, groups.size());
    if (fresh)
    {
      groups.push_back({ wanted[i].tile, {}, {} });
      far = far || wanted[i].tile->readCost().far();
    }
    groups[found->second].nodes.push_back(wanted[i].node);
    groups[found->second].places.push_back(i);
  }
  std::vector<std::optional<Result<FetchedNode>>> found(wanted.size());
  const std::function<bool()> stopped = StopOfReads::carry();
  runWaiting(groups.size(), far ? tilesAtOnce : 1,
    [&](std::size_t g)
    {
      const StopOfReads alsoStopped(stopped);
      std::vector<Result<FetchedNode>> own = groups[g].tile->fetchAll(groups[g].nodes, stop);
      for (std::size_t i = 0; i < own.size(); ++i)
      {
        found[groups[g].places[i]] = std::move(own[i]);
      }
    });
  std::vector<Result<FetchedNode>> results;
  results.reserve(found.size());
  for (std::optional<Result<FetchedNode>>& each : found)
  {
    results.push_back(std::move(*each));
  }
  return results;
}

NodeColumns sliced(
  const NodeColumns& node, std::size_t begin, std::size_t end, const AttributeSchema& schema)
{
  NodeColumns part;
  part.origin = node.origin;
  part.selection = node.selection;
  const auto at = [](const auto& values, std::size_t place)
  { return values.begin() + static_cast<std::ptrdiff_t>(place); };
  part.positions.assign(at(node.positions, begin), at(node.positions, end));
  for (std::size_t c = 0; c < node.columns.size(); ++c)
  {
    const std::size_t bytes = schema[node.selection[c]].bytes();
    const std::vector<std::byte>& values = node.columns[c];
    part.columns.emplace_back(at(values, begin * bytes), at(values, end * bytes));
  }
  return part;
}

void raiseOpenFiles(std::size_t tiles)
{
  constexpr rlim_t others = 256;
  rlimit limit = {};
  const rlim_t wanted = static_cast<rlim_t>(2 * tiles) + others; // an index has two files
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < wanted)
  {
    limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? wanted : std::min(wanted, limit.rlim_max);
    ::setrlimit(RLIMIT_NOFILE, &limit); // where it is refused, open() says so
  }
}

} // namespace pointfront
