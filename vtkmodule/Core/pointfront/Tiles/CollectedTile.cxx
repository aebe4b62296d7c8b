#include "pointfront/Tiles/CollectedTile.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr std::size_t identityHead = std::size_t(64) << 10;
constexpr std::size_t identityTail = std::size_t(256) << 10;

glm::dvec3 vectorOf(ByteReader& in)
{
  const double x = in.get<double>();
  const double y = in.get<double>();
  return { x, y, in.get<double>() };
}

void putRoot(ByteWriter& out, const TileRoot& root)
{
  const Node& row = root.row;
  out.put(root.node);
  out.put(root.head);
  for (int axis = 0; axis < 3; ++axis)
  {
    out.put(row.centre[axis]);
    out.put(row.halfSize[axis]);
  }
  out.put(row.radius);
  out.put(row.spacing);
  out.put(row.splatRadius);
  out.put(row.pointCount);
  out.put(row.pointsBelow);
  out.put(row.firstPoint);
  out.put(row.firstChild);
  out.put(row.childCount);
  out.put(row.layer);
}

TileRoot rootOf(ByteReader& in)
{
  TileRoot root;
  Node& row = root.row;
  root.node = in.get<std::uint32_t>();
  root.head = in.get<std::uint32_t>();
  for (int axis = 0; axis < 3; ++axis)
  {
    row.centre[axis] = in.get<double>();
    row.halfSize[axis] = in.get<float>();
  }
  row.radius = in.get<float>();
  row.spacing = in.get<float>();
  row.splatRadius = in.get<float>();
  row.pointCount = in.get<std::uint32_t>();
  row.pointsBelow = in.get<std::uint64_t>();
  row.firstPoint = in.get<std::uint64_t>();
  row.firstChild = in.get<std::uint32_t>();
  row.childCount = in.get<std::uint8_t>();
  row.layer = in.get<std::uint16_t>();
  return root;
}

std::size_t componentsOf(const AttributeSchema& schema)
{
  std::size_t sum = 0;
  for (const Attribute& attribute : schema)
  {
    sum += attribute.components;
  }
  return sum;
}

bool rootIsSound(const TileRoot& root, const CollectedTile& tile, std::size_t layers)
{
  const Node& row = root.row;
  const bool links = row.leaf() ? row.firstChild == noNode
                                : row.firstChild > root.node && row.firstChild < tile.nodes &&
      row.childCount <= tile.nodes - row.firstChild;
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto size = [](float value) { return std::isfinite(value) && value >= 0.0f; };
  return links && root.node < tile.nodes && row.layer < layers && root.head <= row.pointCount &&
    row.pointCount <= row.pointsBelow && row.pointsBelow <= tile.pointCount &&
    finite(row.centre.x) && finite(row.centre.y) && finite(row.centre.z) && size(row.halfSize.x) &&
    size(row.halfSize.y) && size(row.halfSize.z) && size(row.radius) && size(row.spacing) &&
    size(row.splatRadius);
}
} // namespace

std::size_t takeCount(ByteReader& in, std::size_t least)
{
  const std::size_t count = in.get<std::uint32_t>();
  if (count > in.remaining() / least)
  {
    std::byte none;
    in.getBytes(&none, in.remaining() + 1); // ok() is false from now on
    return 0;
  }
  return count;
}

void putBounds(ByteWriter& out, const Bounds& bounds)
{
  for (const glm::dvec3& corner : { bounds.low, bounds.high })
  {
    out.put(corner.x);
    out.put(corner.y);
    out.put(corner.z);
  }
}

Bounds takeBounds(ByteReader& in)
{
  const glm::dvec3 low = vectorOf(in);
  return { low, vectorOf(in) };
}

Result<TileIdentity> TileIdentity::of(const std::string& path)
{
  // With what the tile needs when it is opened, identityHead and identityTail at least.
  const Result<std::shared_ptr<const ByteSource>> source = StoredCloudFormats::openFar(path);
  if (!source)
  {
    return source.error();
  }
  TileIdentity is;
  is.bytes = (*source)->bytes();
  const auto head = static_cast<std::size_t>(std::min<std::uint64_t>(is.bytes, identityHead));
  const auto tail = static_cast<std::size_t>(std::min<std::uint64_t>(is.bytes, identityTail));
  const Result<RawBytes> first = (*source)->readAt(0, head);
  const Result<RawBytes> last = first ? (*source)->readAt(is.bytes - tail, tail) : first.error();
  if (!last)
  {
    return last.error();
  }
  is.head = checksumOf(first->data.get(), first->size);
  is.tail = checksumOf(last->data.get(), last->size);
  return is;
}

void TileName::put(ByteWriter& out) const
{
  out.put(id);
  out.putText(address);
  out.putText(name);
  out.putText(epoch);
  out.put(identity.bytes);
  out.put(identity.head);
  out.put(identity.tail);
}

TileName TileName::take(ByteReader& in)
{
  TileName is;
  is.id = in.get<std::uint32_t>();
  is.address = in.getText();
  is.name = in.getText();
  is.epoch = in.getText();
  is.identity.bytes = in.get<std::uint64_t>();
  is.identity.head = in.get<std::uint32_t>();
  is.identity.tail = in.get<std::uint32_t>();
  return is;
}

void CollectedTile::put(ByteWriter& out) const
{
  is.put(out);
  out.put(kind);
  putBounds(out, { grid.scale, grid.offset });
  putBounds(out, bounds);
  out.put(pointCount);
  out.put(wholeCount);
  out.put(fileBytes);
  out.put(levels);
  out.put(nodes);
  out.put(ownPoints);
  out.put(static_cast<std::uint32_t>(ranges.size()));
  for (const std::array<double, 2>& range : ranges)
  {
    out.put(range[0]);
    out.put(range[1]);
  }
  out.put(static_cast<std::uint32_t>(layers.size()));
  for (const auto& [own, count] : layers)
  {
    out.put(own);
    out.put(count);
  }
  out.put(static_cast<std::uint32_t>(roots.size()));
  for (const TileRoot& root : roots)
  {
    putRoot(out, root);
  }
}

CollectedTile CollectedTile::take(ByteReader& in)
{
  CollectedTile tile;
  tile.is = TileName::take(in);
  tile.kind = in.get<std::uint32_t>();
  tile.grid.scale = vectorOf(in);
  tile.grid.offset = vectorOf(in);
  tile.bounds = takeBounds(in);
  tile.pointCount = in.get<std::uint64_t>();
  tile.wholeCount = in.get<std::uint64_t>();
  tile.fileBytes = in.get<std::uint64_t>();
  tile.levels = in.get<std::uint32_t>();
  tile.nodes = in.get<std::uint32_t>();
  tile.ownPoints = in.get<std::uint64_t>();
  tile.ranges.resize(takeCount(in, 16));
  for (std::array<double, 2>& range : tile.ranges)
  {
    range[0] = in.get<double>();
    range[1] = in.get<double>();
  }
  tile.layers.resize(takeCount(in, 12));
  for (auto& [points, nodes] : tile.layers)
  {
    points = in.get<std::uint64_t>();
    nodes = in.get<std::uint32_t>();
  }
  const std::size_t roots = takeCount(in, 64);
  tile.roots.reserve(roots);
  for (std::size_t r = 0; r < roots; ++r)
  {
    tile.roots.push_back(rootOf(in));
  }
  return tile;
}

bool CollectedTile::isSound(const std::vector<StoreDescription>& kinds) const
{
  if (kind >= kinds.size() || roots.empty() || is.address.empty())
  {
    return false;
  }
  const StoreDescription& shared = kinds[kind];
  const bool scaled = grid.scale.x > 0.0 && grid.scale.y > 0.0 && grid.scale.z > 0.0;
  bool sound = scaled && ranges.size() == componentsOf(shared.schema) &&
    layers.size() == shared.layers.size() && ownPoints >= pointCount;
  for (std::size_t r = 0; r < roots.size(); ++r)
  {
    sound = sound && rootIsSound(roots[r], *this, shared.layers.size()) &&
      (r == 0 || roots[r - 1].node < roots[r].node);
  }
  return sound;
}

double diagonalOf(const Bounds& bounds)
{
  return bounds.empty() ? 0.0 : glm::length(bounds.size());
}

void AlikeTiles::begin(const StoreDescription& first)
{
  together = first;
  together.wholeCount = first.pointCount + first.missingPoints();
  count = 1;
  lengths = diagonalOf(first.bounds);
}

void AlikeTiles::add(const CollectedTile& tile)
{
  ++count;
  lengths += diagonalOf(tile.bounds);
  together.fileBytes += tile.fileBytes;
  together.pointCount += tile.pointCount;
  together.wholeCount += std::max(tile.pointCount, tile.wholeCount);
  together.bounds.add(tile.bounds);
  together.levels = std::max(together.levels, tile.levels);
  auto ends = tile.ranges.begin();
  for (ColumnRange& range : together.ranges)
  {
    for (std::array<double, 2>& all : range.components)
    {
      all = { std::min(all[0], (*ends)[0]), std::max(all[1], (*ends)[1]) };
      ++ends;
    }
  }
  for (std::size_t layer = 0; layer < tile.layers.size(); ++layer)
  {
    together.layers[layer].pointCount += tile.layers[layer].first;
    together.layers[layer].nodeCount += tile.layers[layer].second;
  }
}

} // namespace pointfront
