#include "pointfront/Tiles/NodeParts.h"

#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/NodeRangesSection.h"

#include <sys/resource.h>

#include <algorithm>

namespace pointfront
{

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

WholeComponent WholeComponent::of(std::uint32_t number, const AttributeSchema& schema)
{
  if (number < coordinateComponents)
  {
    return { 0, number, nullptr };
  }
  std::uint32_t left = number - coordinateComponents;
  std::uint32_t column = 0;
  for (; left >= schema[column].components; ++column)
  {
    left -= static_cast<std::uint32_t>(schema[column].components);
  }
  return { column, left, &schema[column] };
}

} // namespace pointfront
