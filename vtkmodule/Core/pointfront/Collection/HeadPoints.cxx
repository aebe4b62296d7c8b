#include "pointfront/Collection/HeadPoints.h"

#include "pointfront/Records/MortonOrder.h"
#include "pointfront/Trees/PrefixOrder.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
/// A fixed, well mixed hash of a place (the finaliser of MurmurHash3).
std::uint32_t hashOf(const glm::u32vec3& p)
{
  std::uint64_t h = (std::uint64_t(p.x) << 32 | p.y) ^ (std::uint64_t(p.z) * 0x9e3779b97f4a7c15u);
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdu;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53u;
  h ^= h >> 33;
  return static_cast<std::uint32_t>(h);
}
} // namespace

HeadPoints HeadPoints::of(const NodeColumns& node, const AttributeSchema& whole, std::uint32_t tile)
{
  HeadPoints points;
  for (const glm::u32vec3& p : node.positions)
  {
    points.positions_.push_back(node.origin + GridPosition(p));
  }
  for (std::size_t c = 0; c < whole.size(); ++c)
  {
    points.columns_.push_back({ whole[c].bytes(), node.columns[c] });
  }
  points.tiles_.assign(node.size(), tile);
  return points;
}

HeadPoints HeadPoints::of(const NodeColumns& node, const AttributeSchema& whole)
{
  HeadPoints points = of(node, whole, 0);
  const std::vector<std::byte>& tiles = node.columns[whole.size()];
  if (!tiles.empty())
  {
    std::memcpy(points.tiles_.data(), tiles.data(), tiles.size());
  }
  return points;
}

void HeadPoints::append(const HeadPoints& other, std::size_t begin, std::size_t end)
{
  if (columns_.empty())
  {
    for (const Column& column : other.columns_)
    {
      columns_.push_back({ column.bytes, {} });
    }
  }
  const auto at = [](const auto& values, std::size_t place)
  { return values.begin() + static_cast<std::ptrdiff_t>(place); };
  positions_.insert(positions_.end(), at(other.positions_, begin), at(other.positions_, end));
  tiles_.insert(tiles_.end(), at(other.tiles_, begin), at(other.tiles_, end));
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    const Column& from = other.columns_[c];
    columns_[c].values.insert(columns_[c].values.end(), at(from.values, begin * from.bytes),
      at(from.values, end * from.bytes));
  }
}

HeadPoints HeadPoints::ofTiles(const std::unordered_set<std::uint32_t>& tiles, bool others) const
{
  HeadPoints kept;
  kept.append(*this, 0, 0);
  for (std::size_t begin = 0; begin < size();)
  {
    const bool wanted = (tiles.count(tiles_[begin]) > 0) != others;
    std::size_t end = begin + 1;
    while (end < size() && ((tiles.count(tiles_[end]) > 0) != others) == wanted)
    {
      ++end;
    }
    if (wanted)
    {
      kept.append(*this, begin, end);
    }
    begin = end;
  }
  return kept;
}

HeadPoints HeadPoints::behind(std::size_t count) const
{
  HeadPoints rest;
  rest.append(*this, std::min(count, size()), size());
  return rest;
}

bool HeadPoints::asNode(const AttributeSchema& heads, NodeColumns& node) const
{
  node = NodeColumns();
  node.selection.resize(heads.size());
  std::iota(node.selection.begin(), node.selection.end(), 0);
  node.columns.resize(heads.size());
  if (positions_.empty())
  {
    return true;
  }
  GridPosition low = positions_.front();
  GridPosition high = low;
  for (const GridPosition& p : positions_)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const GridPosition extent = high - low;
  if (std::max({ extent.x, extent.y, extent.z }) > std::numeric_limits<std::uint32_t>::max())
  {
    return false;
  }
  std::vector<TreePosition> local;
  for (const GridPosition& p : positions_)
  {
    local.emplace_back(p - low);
  }
  std::vector<std::uint32_t> order(size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return mortonLess(local[a], local[b]); });
  std::vector<NumberedHash> hashes;
  for (const std::uint32_t i : order)
  {
    hashes.push_back({ i, hashOf(local[i]) });
  }
  order = prefixBatches(std::move(hashes));
  node.origin = low;
  for (std::size_t c = 0; c < heads.size(); ++c)
  {
    const bool tile = c + 1 == heads.size();
    const auto* const from =
      tile ? reinterpret_cast<const std::byte*>(tiles_.data()) : columns_[c].values.data();
    const std::size_t bytes = tile ? sizeof(std::uint32_t) : columns_[c].bytes;
    node.columns[c].resize(size() * bytes);
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      std::memcpy(node.columns[c].data() + i * bytes, from + order[i] * bytes, bytes);
    }
  }
  for (const std::uint32_t i : order)
  {
    node.positions.push_back(local[i]);
  }
  return true;
}

} // namespace pointfront
