#include "SortedRasterValues.h"

#include "pointfront/Neighbourhood/PointTiles.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>

namespace pointfront
{
namespace
{
/// Chunks that are asked how many tiles they touch.
constexpr std::uint64_t askedChunks = 8;
/// Decoding a tile so often costs more than two readings of the points.
constexpr double worthwhile = 2.0;
constexpr std::uint64_t mostTilePoints = 1u << 17;
/// A point takes them while its tile is looked up: for itself, its places, its hit, its value.
constexpr std::uint64_t lookupBytes = 256;

// Shares of the whole, for the progress fraction.
constexpr double readShare = 0.25; // twice
constexpr double lookupShare = 0.5;
} // namespace

Result<bool> SortedRasterValues::areNeeded(const PointSources& sources, const Inputs& inputs,
  const ImageValuesPass::Images& images, const PassResources& resources)
{
  double allBytes = 0.0;
  double allTiles = 0.0;
  for (const RasterMosaic& mosaic : images.mosaics)
  {
    allBytes += double(mosaic.tiles().bytes);
    allTiles += double(mosaic.tiles().count);
  }
  const InputOrder order(sources);
  if (allBytes <= double(images.tileBytes) || order.chunks() == 0)
  {
    return false; // each is decoded once anyway
  }
  const std::uint64_t asked = std::min(askedChunks, order.chunks());
  double bytes = 0.0;
  double tiles = 0.0;
  PointBatch batch;
  for (std::uint64_t i = 0; i < asked; ++i)
  {
    const SourceChunk chunk = order.chunk(i * order.chunks() / asked);
    if (Result<void> done = sources[chunk.source]->read(chunk.chunk, batch); !done)
    {
      return done.error();
    }
    for (std::size_t m = 0; m < images.mosaics.size(); ++m)
    {
      const auto touched = images.mosaics[m].tilesOf(batch.positions, inputs[chunk.source][m].ways);
      if (!touched)
      {
        return touched.error();
      }
      bytes += double(touched->bytes) / double(asked);
      tiles += double(touched->count) / double(asked);
    }
  }
  const auto threads = double(std::min<std::uint64_t>(threadsOf(resources), order.chunks()));
  return bytes * threads > double(images.tileBytes) &&
    tiles * double(order.chunks()) > worthwhile * allTiles;
}

SortedRasterValues::SortedRasterValues(InputOrder order, const Inputs& inputs)
  : order_(std::move(order))
{
  for (std::size_t input = 0; input < inputs.front().size(); ++input)
  {
    std::size_t widest = 0; // sources may have columns of different types
    for (const std::vector<RasterSource::Input>& own : inputs)
    {
      widest = std::max(widest, own[input].column.attribute().bytes());
    }
    places_.push_back(bytes_);
    bytes_ += 1 + widest;
  }
}

/// Looks up the points of one tile of the cloud after another.
class SortedRasterValues::Lookup
{
public:
  Lookup(SortedRasterValues& values, const PointTiles& tiles, const PointSources& sources,
    const Inputs& inputs, const ImageValuesPass::Images& images, WorkCrew& crew)
    : values_(values)
    , tiles_(tiles)
    , inputs_(inputs)
    , images_(images)
    , crew_(crew)
  {
    std::uint64_t first = 0;
    for (const auto& source : sources)
    {
      for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
      {
        first += source->chunkPoints(chunk);
      }
      ends_.push_back(first);
    }
    for (std::size_t m = 0; m < images.mosaics.size(); ++m)
    {
      std::vector<std::size_t>& likeIt = likeIt_.emplace_back();
      for (std::size_t s = 0; s < inputs.size(); ++s)
      {
        std::size_t like = 0;
        while (like < s && (likeIt[like] != like || inputs[like][m].ways != inputs[s][m].ways))
        {
          ++like;
        }
        likeIt.push_back(like);
      }
    }
  }

  /// The work of one thread.
  Result<void> work()
  {
    for (std::size_t t = next_++; t < tiles_.count() && !crew_.stopped(); t = next_++)
    {
      if (Result<void> done = lookUp(t); !done)
      {
        return done;
      }
    }
    return {};
  }

private:
  Result<void> lookUp(std::size_t tile) const;
  Result<void> lookUp(std::size_t mosaic, const std::vector<TilePoint>& points,
    const std::vector<std::size_t>& sources, std::vector<std::byte>& values) const;

  SortedRasterValues& values_;
  const PointTiles& tiles_;
  const Inputs& inputs_;
  const ImageValuesPass::Images& images_;
  WorkCrew& crew_;
  std::vector<std::uint64_t> ends_; ///< number of the last point of each source, in input order
  /// For each mosaic and source: the first source with the same ways to the mosaic. Their points
  /// are looked up together: a tile is wanted by all of them.
  std::vector<std::vector<std::size_t>> likeIt_;
  std::atomic<std::size_t> next_{ 0 };
};

Result<void> SortedRasterValues::Lookup::lookUp(std::size_t tile) const
{
  Result<std::vector<TilePoint>> own = tiles_.own(tile);
  if (!own)
  {
    return own.error();
  }
  std::sort(own->begin(), own->end(),
    [](const TilePoint& a, const TilePoint& b) { return a.number() < b.number(); });
  std::vector<std::byte> values(own->size() * values_.bytes_);
  std::vector<std::uint64_t> numbers;
  std::vector<std::size_t> sources; // the source of each point
  std::size_t source = 0;
  for (const TilePoint& point : *own)
  {
    while (point.number() >= ends_[source])
    {
      ++source;
    }
    numbers.push_back(point.number());
    sources.push_back(source);
  }
  for (std::size_t m = 0; m < images_.mosaics.size(); ++m)
  {
    if (Result<void> done = lookUp(m, *own, sources, values); !done)
    {
      return done;
    }
  }
  crew_.advance(own->size());
  return values_.column_->write(numbers, values);
}

Result<void> SortedRasterValues::Lookup::lookUp(std::size_t mosaic,
  const std::vector<TilePoint>& points, const std::vector<std::size_t>& sources,
  std::vector<std::byte>& values) const
{
  std::map<std::size_t, std::vector<std::size_t>> groups; // points of sources that are alike
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    groups[likeIt_[mosaic][sources[i]]].push_back(i);
  }
  for (const auto& [like, members] : groups)
  {
    std::vector<glm::dvec3> positions;
    for (const std::size_t i : members)
    {
      positions.push_back(points[i].position);
    }
    const auto store = [&, &own = members](
                         std::size_t point, const RasterFile& file, const std::byte* pixel)
    {
      const std::size_t i = own[point];
      std::byte* const value = values.data() + i * values_.bytes_ + values_.places_[mosaic];
      const auto outcome = inputs_[sources[i]][mosaic].column.store(file, pixel, value + 1);
      if (outcome == RasterColumn::Outcome::NoData)
      {
        return false;
      }
      *value = static_cast<std::byte>(
        outcome == RasterColumn::Outcome::Taken ? Outcome::Taken : Outcome::NotHeld);
      return true;
    };
    const Result<std::uint64_t> without =
      images_.mosaics[mosaic].sample(positions, inputs_[like][mosaic].ways, store);
    if (!without)
    {
      return without.error();
    }
  }
  return {};
}

Result<std::shared_ptr<const SortedRasterValues>> SortedRasterValues::compute(
  const PointSources& sources, const Inputs& inputs, const ImageValuesPass::Images& images,
  const PassResources& resources)
{
  std::shared_ptr<SortedRasterValues> values(new SortedRasterValues(InputOrder(sources), inputs));
  Result<std::unique_ptr<PointColumn>> column =
    PointColumn::create(resources, values->order_.points(), values->bytes_);
  if (!column)
  {
    return column.error();
  }
  values->column_ = std::move(*column);
  WorkCrew crew(threadsOf(resources), resources.progress);
  TilingOptions tiling;
  tiling.axes = 2;
  tiling.tilePoints = std::clamp<std::uint64_t>(
    memoryOf(resources) / 2 / crew.threads() / lookupBytes, 1u << 12, mostTilePoints);
  tiling.halo = std::numeric_limits<double>::min(); // no point needs another
  Participants participants;
  participants.references.reset();
  const Result<std::unique_ptr<PointTiles>> tiles =
    PointTiles::make(sources, values->order_, tiling, participants, resources, crew, readShare);
  if (!tiles)
  {
    return tiles.error();
  }
  crew.beginPhase("looking up pixels", values->order_.points(), lookupShare);
  Lookup lookup(*values, **tiles, sources, inputs, images, crew);
  if (Result<void> done = crew.run([&lookup] { return lookup.work(); }); !done)
  {
    return done.error();
  }
  return std::shared_ptr<const SortedRasterValues>(std::move(values));
}

Result<std::vector<std::byte>> SortedRasterValues::read(
  const SourceChunk& chunk, std::uint64_t points) const
{
  std::vector<std::byte> values(points * bytes_);
  if (Result<void> done = column_->read(order_.first(chunk), points, values.data()); !done)
  {
    return done.error();
  }
  return values;
}

} // namespace pointfront
