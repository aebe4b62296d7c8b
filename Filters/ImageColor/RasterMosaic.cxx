#include "RasterMosaic.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace pointfront
{
namespace
{
/// Cells for each image, so that a point looks at few images that do not hold it.
constexpr double cellsPerImage = 4.0;
constexpr int mostCells = 1024; // on a side

int cellAt(double value, double low, double cell, int count)
{
  return std::clamp(static_cast<int>((value - low) / cell), 0, count - 1);
}
} // namespace

Result<RasterMosaic> RasterMosaic::open(const std::vector<std::string>& paths, RasterUse use,
  const CoordinateSystems& systems, RasterTiles& tiles)
{
  RasterMosaic mosaic;
  mosaic.tiles_ = &tiles;
  for (const std::string& path : paths)
  {
    Result<RasterFile> file = RasterFile::open(path, use, systems);
    if (!file)
    {
      return file.error();
    }
    if (use == RasterUse::Values && !mosaic.files_.empty())
    {
      const RasterFile& first = mosaic.files_.front();
      if (file->type != first.type || file->dataChannels() != first.dataChannels())
      {
        return makeError(Error::Kind::BadArgument,
          path + ": has " + std::to_string(file->dataChannels()) + " x " +
            std::string(nameOf(file->type)) + " a pixel, " + first.path + " has " +
            std::to_string(first.dataChannels()) + " x " + std::string(nameOf(first.type)) +
            "; give them to different attributes, or convert one");
      }
    }
    Result<std::uint32_t> number = tiles.add(*file);
    if (!number)
    {
      return number.error();
    }
    mosaic.numbers_.push_back(*number);
    mosaic.files_.push_back(std::move(*file));
  }
  mosaic.group();
  return mosaic;
}

void RasterMosaic::group()
{
  std::vector<std::string> names; // WKT of each group
  for (std::uint32_t i = 0; i < files_.size(); ++i)
  {
    const std::string name = files_[i].system ? files_[i].system->wkt : std::string();
    const auto known = std::find(names.begin(), names.end(), name);
    const std::size_t g = static_cast<std::size_t>(known - names.begin());
    if (known == names.end())
    {
      names.push_back(name);
      groups_.emplace_back();
    }
    groups_[g].images.push_back(i);
    groups_[g].ground.add(files_[i].ground());
  }
  for (Group& group : groups_)
  {
    const glm::dvec3 size = group.ground.size();
    const double cells = cellsPerImage * static_cast<double>(group.images.size());
    const double area = size.x * size.y / cells;
    const double side = std::max({ std::sqrt(area), size.x / mostCells, size.y / mostCells });
    group.across = std::max(1, static_cast<int>(std::ceil(size.x / side)));
    group.down = std::max(1, static_cast<int>(std::ceil(size.y / side)));
    group.cell = { size.x / group.across, size.y / group.down };
    group.touching.resize(static_cast<std::size_t>(group.across) * group.down);
    for (const std::uint32_t image : group.images)
    {
      const Bounds ground = files_[image].ground();
      const Bounds& all = group.ground;
      const int left = cellAt(ground.low.x, all.low.x, group.cell.x, group.across);
      const int right = cellAt(ground.high.x, all.low.x, group.cell.x, group.across);
      const int lower = cellAt(ground.low.y, all.low.y, group.cell.y, group.down);
      const int upper = cellAt(ground.high.y, all.low.y, group.cell.y, group.down);
      for (int row = lower; row <= upper; ++row)
      {
        for (int column = left; column <= right; ++column)
        {
          group.touching[static_cast<std::size_t>(row) * group.across + column].push_back(image);
        }
      }
    }
  }
}

std::vector<std::size_t> RasterMosaic::groupLeaders() const
{
  std::vector<std::size_t> leaders;
  for (const Group& group : groups_)
  {
    leaders.push_back(group.images.front());
  }
  return leaders;
}

bool RasterMosaic::find(const Group& group, const glm::dvec3& p, std::uint32_t from, Hit& hit) const
{
  const Bounds& all = group.ground;
  if (!(p.x >= all.low.x && p.x <= all.high.x && p.y >= all.low.y && p.y <= all.high.y))
  {
    return false;
  }
  const int column = cellAt(p.x, all.low.x, group.cell.x, group.across);
  const int row = cellAt(p.y, all.low.y, group.cell.y, group.down);
  for (const std::uint32_t image :
    group.touching[static_cast<std::size_t>(row) * group.across + column])
  {
    if (image < from)
    {
      continue;
    }
    const RasterFile& file = files_[image];
    const glm::dvec2 pixel = glm::floor(file.transform.toPixel({ p.x, p.y }));
    if (pixel.x >= 0.0 && pixel.x < file.width && pixel.y >= 0.0 && pixel.y < file.height)
    {
      const RasterTiles::Layout& layout = tiles_->layout(numbers_[image]);
      const int x = static_cast<int>(pixel.x);
      const int y = static_cast<int>(pixel.y);
      hit.image = image;
      hit.tile = static_cast<std::uint32_t>(y / layout.height * layout.across + x / layout.width);
      hit.pixel = static_cast<std::uint32_t>(y % layout.height * layout.width + x % layout.width);
      return true;
    }
  }
  return false;
}

Result<std::vector<std::vector<glm::dvec3>>> RasterMosaic::positionsOf(
  const std::vector<glm::dvec3>& positions, const Ways& ways) const
{
  std::vector<std::vector<glm::dvec3>> moved(groups_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g)
  {
    if (!ways[g])
    {
      continue; // the points' own positions serve
    }
    moved[g] = positions;
    if (Result<void> done = ways[g]->apply(moved[g].data(), moved[g].size()); !done)
    {
      return done.error();
    }
  }
  return moved;
}

Result<void> RasterMosaic::visitHits(
  const std::vector<Hit>& hits, const Visit& visit, std::vector<std::uint32_t>& refused) const
{
  for (std::size_t begin = 0; begin < hits.size();)
  {
    const std::uint32_t image = hits[begin].image;
    const std::uint32_t number = hits[begin].tile;
    const RasterTiles::Layout& layout = tiles_->layout(numbers_[image]);
    const int across = layout.across;
    const Result<RasterTiles::Tile> tile =
      tiles_->tile(numbers_[image], static_cast<int>(number) % across * layout.width,
        static_cast<int>(number) / across * layout.height);
    if (!tile)
    {
      return tile.error();
    }
    const std::size_t bytes = files_[image].pixelBytes();
    for (; begin < hits.size() && hits[begin].image == image && hits[begin].tile == number; ++begin)
    {
      const std::byte* pixel = tile.value().pixels() + hits[begin].pixel * bytes;
      if (!visit(hits[begin].point, files_[image], pixel))
      {
        refused.push_back(static_cast<std::uint32_t>(begin));
      }
    }
  }
  return {};
}

/// The first image from `from` on that has a pixel for the point.
std::optional<RasterMosaic::Hit> RasterMosaic::firstHit(const std::vector<glm::dvec3>& positions,
  const std::vector<std::vector<glm::dvec3>>& moved, std::size_t point, std::uint32_t from) const
{
  std::optional<Hit> best;
  for (std::size_t g = 0; g < groups_.size(); ++g)
  {
    Hit hit;
    const std::vector<glm::dvec3>& own = moved[g].empty() ? positions : moved[g];
    if (find(groups_[g], own[point], from, hit) && (!best || hit.image < best->image))
    {
      hit.point = static_cast<std::uint32_t>(point);
      best = hit;
    }
  }
  return best;
}

std::uint64_t RasterMosaic::tileBytes(std::uint32_t image) const
{
  const RasterTiles::Layout& layout = tiles_->layout(numbers_[image]);
  return static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height) *
    files_[image].pixelBytes();
}

RasterMosaic::Tiles RasterMosaic::tiles() const
{
  Tiles all;
  for (std::uint32_t image = 0; image < files_.size(); ++image)
  {
    const RasterTiles::Layout& layout = tiles_->layout(numbers_[image]);
    const int down = (files_[image].height + layout.height - 1) / layout.height;
    const std::uint64_t count =
      static_cast<std::uint64_t>(layout.across) * static_cast<std::uint64_t>(down);
    all.count += count;
    all.bytes += count * tileBytes(image);
  }
  return all;
}

Result<RasterMosaic::Tiles> RasterMosaic::tilesOf(
  const std::vector<glm::dvec3>& positions, const Ways& ways) const
{
  const Result<std::vector<std::vector<glm::dvec3>>> moved = positionsOf(positions, ways);
  if (!moved)
  {
    return moved.error();
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> touched; // image, tile
  for (std::size_t point = 0; point < positions.size(); ++point)
  {
    if (const std::optional<Hit> hit = firstHit(positions, *moved, point, 0))
    {
      touched.emplace(hit->image, hit->tile);
    }
  }
  Tiles tiles;
  for (const auto& [image, tile] : touched)
  {
    ++tiles.count;
    tiles.bytes += tileBytes(image);
  }
  return tiles;
}

Result<std::uint64_t> RasterMosaic::sample(
  const std::vector<glm::dvec3>& positions, const Ways& ways, const Visit& visit) const
{
  const Result<std::vector<std::vector<glm::dvec3>>> moved = positionsOf(positions, ways);
  if (!moved)
  {
    return moved.error();
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pending; // point, first image to ask
  for (std::uint32_t i = 0; i < positions.size(); ++i)
  {
    pending.emplace_back(i, 0);
  }
  std::uint64_t without = 0;
  std::vector<Hit> hits;
  std::vector<std::uint32_t> refused;
  while (!pending.empty())
  {
    hits.clear();
    for (const auto& [point, from] : pending)
    {
      if (const std::optional<Hit> hit = firstHit(positions, *moved, point, from))
      {
        hits.push_back(*hit);
      }
      else
      {
        ++without;
      }
    }
    std::sort(hits.begin(), hits.end(),
      [](const Hit& a, const Hit& b)
      { return std::tie(a.image, a.tile, a.point) < std::tie(b.image, b.tile, b.point); });
    refused.clear();
    if (Result<void> done = visitHits(hits, visit, refused); !done)
    {
      return done.error();
    }
    pending.clear();
    for (const std::uint32_t h : refused)
    {
      pending.emplace_back(hits[h].point, hits[h].image + 1);
    }
  }
  return without;
}

} // namespace pointfront
