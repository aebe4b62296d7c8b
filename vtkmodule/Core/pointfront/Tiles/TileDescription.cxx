#include "pointfront/Tiles/TileDescription.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Points/GpsTimes.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/HeldColours.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
/// A store, or several that are alike.
struct DescribedTiles
{
  const StoreDescription* is = nullptr;
  std::size_t count = 1;
  double lengths = 0.0; ///< diagonals of their boxes, added up

  const StoreDescription* operator->() const { return is; }
};
using Tiles = std::vector<DescribedTiles>;

/// A tile as a source for commonSchema().
class DescribedTile final : public PointSource
{
public:
  explicit DescribedTile(const StoreDescription& store)
  {
    description_.path = store.path;
    description_.schema = store.schema;
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return 0; }
  std::uint64_t chunkPoints(std::uint64_t) const override { return 0; }
  Result<void> read(std::uint64_t, PointBatch&) const override { return {}; }

private:
  SourceDescription description_;
};

std::size_t countOf(const Tiles& tiles)
{
  return std::accumulate(tiles.begin(), tiles.end(), std::size_t(0),
    [](std::size_t sum, const DescribedTiles& tile) { return sum + tile.count; });
}

std::string countOf(std::size_t some, std::size_t all)
{
  return std::to_string(some) + " of " + std::to_string(all) + " stores";
}

Result<void> addSums(StoreDescription& whole, const Tiles& tiles)
{
  const StoreDescription& first = *tiles.front().is;
  whole.structure = "tiles";
  whole.version = first.version;
  whole.refinement = first.refinement;
  whole.crsWkt = first.crsWkt;
  whole.metadata = first.metadata;
  whole.generator = first.generator;
  for (const DescribedTiles& tile : tiles)
  {
    if (tile->refinement != first.refinement)
    {
      return makeError(Error::Kind::BadArgument,
        whole.path + ": '" + tile->path + "' and '" + first.path +
          "' are refined in different ways (add and replace); they cannot be drawn as one cloud: "
          "build them alike, or open them as separate clouds");
    }
    whole.fileBytes += tile->fileBytes;
    whole.pointCount += tile->pointCount;
    whole.wholeCount += tile->pointCount + tile->missingPoints();
    whole.bounds.add(tile->bounds);
    whole.levels = std::max(whole.levels, tile->levels);
    whole.splatRadiusBase = std::max(whole.splatRadiusBase, tile->splatRadiusBase);
  }
  return {};
}

/// The mappings of all tiles to the common schema, which becomes that of the whole.
Result<std::vector<TileColumns>> chooseColumns(StoreDescription& whole, const Tiles& tiles)
{
  std::vector<std::unique_ptr<PointSource>> sources;
  for (const DescribedTiles& tile : tiles)
  {
    sources.push_back(std::make_unique<DescribedTile>(*tile.is));
  }
  Result<CommonSchema> common = commonSchema(sources, std::nullopt);
  if (!common)
  {
    return makeError(common.error().kind, whole.path + ": " + common.error().what);
  }
  whole.schema = std::move(common->schema);
  const auto radius = whole.schema.find(splatRadiusAttribute);
  const auto colour = wideColourColumn(whole.schema);
  const bool deep = std::any_of(tiles.begin(), tiles.end(),
    [](const DescribedTiles& tile) { return heldColours(*tile.is) == HeldColours::Sixteen; });
  std::vector<TileColumns> columns;
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    columns.emplace_back(tiles[t]->schema, std::move(common->mappings[t]));
    const double base = tiles[t]->splatRadiusBase;
    if (radius && !columns.back().lacks(*radius) && base != whole.splatRadiusBase)
    {
      columns.back().recodeRadii(base, whole.splatRadiusBase);
    }
    if (colour && deep && heldColours(*tiles[t].is) == HeldColours::Eight)
    {
      columns.back().widenColours();
    }
  }
  return columns;
}

void compareColumns(
  StoreDescription& whole, const Tiles& tiles, const std::vector<TileColumns>& columns)
{
  const std::size_t all = countOf(tiles);
  std::map<std::size_t, std::string> lacked; // how many stores lack which
  for (std::size_t c = 0; c < whole.schema.size(); ++c)
  {
    const Attribute& attribute = whole.schema[c];
    std::size_t lacking = 0;
    std::size_t differing = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t)
    {
      lacking += columns[t].lacks(c) ? tiles[t].count : 0;
      differing += columns[t].converts(c) ? tiles[t].count : 0;
    }
    if (lacking > 0)
    {
      std::string& names = lacked[lacking];
      names += (names.empty() ? "" : ", ") + attribute.name;
    }
    if (differing > 0)
    {
      whole.warnings.push_back("The attribute '" + attribute.name + "' is taken as " +
        std::string(nameOf(attribute.type)) + ", because its type or scale differs in " +
        countOf(differing, all) + ".");
    }
  }
  for (const auto& [lacking, names] : lacked)
  {
    whole.warnings.push_back(
      countOf(lacking, all) + " lack " + names + "; zeros are shown for their points.");
  }
}

/// Columns that no tile holds, and some tiles compute.
ColumnSelection computedColumns(const StoreDescription& whole, const Tiles& tiles)
{
  ColumnSelection computed;
  for (std::uint32_t c = 0; c < whole.schema.size(); ++c)
  {
    const bool held = std::any_of(tiles.begin(), tiles.end(),
      [&](const DescribedTiles& tile)
      {
        const auto own = tile->schema.find(whole.schema[c].name);
        return own && !tile->isComputed(*own);
      });
    if (!held)
    {
      computed.push_back(c);
    }
  }
  return computed;
}

void chooseGrid(
  StoreDescription& whole, std::size_t stores, const std::vector<QuantisationGrid>& grids)
{
  whole.grid = TilePlacing::commonGrid(grids);
  std::size_t rounded = 0;
  for (const QuantisationGrid& grid : grids)
  {
    rounded += TilePlacing(grid, whole.grid).exact() ? 0 : 1;
  }
  if (rounded > 0)
  {
    const glm::dvec3 most = 0.5 * whole.grid.scale;
    whole.warnings.push_back(countOf(rounded, stores) +
      " do not lie on the grid of the finest; their points are rounded, by at most " +
      numberText(most.x, 9) + ", " + numberText(most.y, 9) + ", " + numberText(most.z, 9) +
      " units.");
  }
}

void compareSystems(StoreDescription& whole, const Tiles& tiles)
{
  std::string known;
  std::string knownOf;
  std::string differing;
  std::size_t different = 0;
  std::size_t silent = 0;
  for (const DescribedTiles& tile : tiles)
  {
    const std::string system = projectionOf(*tile.is);
    if (system.empty())
    {
      silent += tile.count;
    }
    else if (known.empty())
    {
      known = system;
      knownOf = tile->path;
      whole.crsWkt = tile->crsWkt;
      whole.metadata = tile->metadata;
    }
    else if (system != known)
    {
      differing = different == 0 ? tile->path : differing;
      different += tile.count;
    }
  }
  const std::size_t all = countOf(tiles);
  if (different > 0)
  {
    whole.warnings.push_back(countOf(different, all) +
      " name another coordinate reference system than '" + knownOf + "', the first '" + differing +
      "': unless both mean the same, they do not lie where they should; build them with one "
      "--crs.");
  }
  if (silent > 0 && !known.empty())
  {
    whole.warnings.push_back(countOf(silent, all) +
      " name no coordinate reference system; they are taken to be in that of '" + knownOf + "'.");
  }
}

void compareTimes(StoreDescription& whole, const Tiles& tiles)
{
  GatheredTimes times;
  for (const DescribedTiles& tile : tiles)
  {
    if (tile->pointCount > 0)
    {
      times.add(tile->path, tile->schema, tile->metadata);
    }
  }
  times.keepIn(whole.metadata);
  if (const std::string warning = times.warning(); !warning.empty())
  {
    whole.warnings.push_back(warning);
  }
}

/// Tiles of a survey are neighbours; one that strayed makes all others small in a picture.
void compareDistances(StoreDescription& whole, const Tiles& tiles)
{
  constexpr double far = 10.0; // times all of them in a row
  double together = 0.0;
  for (const DescribedTiles& tile : tiles)
  {
    together += tile.lengths;
  }
  const double extent = diagonalOf(whole.bounds);
  if (together > 0.0 && extent > far * together)
  {
    whole.warnings.push_back("Its stores lie far apart: they extend over " + numberText(extent, 6) +
      " units, and in a row they would be " + numberText(together, 6) +
      " units long; in a picture of all they are small.");
  }
}

/// Adds the layers of all tiles, in the order of their classes.
std::vector<std::vector<std::uint16_t>> addLayers(StoreDescription& whole, const Tiles& tiles)
{
  std::map<std::pair<std::uint16_t, std::string>, Layer> layers;
  for (const DescribedTiles& tile : tiles)
  {
    for (const Layer& layer : tile->layers)
    {
      Layer& common = layers[{ layer.objectClass, layer.name }];
      common.objectClass = layer.objectClass;
      common.name = layer.name;
      common.pointCount += layer.pointCount;
      common.nodeCount += layer.nodeCount;
    }
  }
  std::map<std::pair<std::uint16_t, std::string>, std::uint16_t> numbers;
  for (auto& [key, layer] : layers)
  {
    numbers[key] = static_cast<std::uint16_t>(whole.layers.size());
    whole.layers.push_back(layer);
  }
  if (layers.size() > 1 && layers.count({ 0, "all" }) > 0)
  {
    whole.warnings.push_back("Some stores have a tree for each class and others one for all "
                             "points: what is said of a class does not reach the latter's points.");
  }
  std::vector<std::vector<std::uint16_t>> own(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    for (const Layer& layer : tiles[t]->layers)
    {
      own[t].push_back(numbers[{ layer.objectClass, layer.name }]);
    }
  }
  return own;
}

/// `grids`: those of all stores, and others whose steps the whole has, too.
Result<TileDescription> describedOf(const std::string& path, const Tiles& tiles,
  const std::vector<QuantisationGrid>& grids, std::vector<std::string> warnings)
{
  TileDescription result;
  StoreDescription& whole = result.whole;
  whole.path = path;
  whole.warnings = std::move(warnings);
  if (Result<void> summed = addSums(whole, tiles); !summed)
  {
    return summed.error();
  }
  Result<std::vector<TileColumns>> columns = chooseColumns(whole, tiles);
  if (!columns)
  {
    return columns.error();
  }
  compareColumns(whole, tiles, *columns);
  chooseGrid(whole, countOf(tiles), grids);
  compareSystems(whole, tiles);
  compareTimes(whole, tiles);
  compareDistances(whole, tiles);
  whole.rangesAreSampled = std::any_of(
    tiles.begin(), tiles.end(), [](const auto& tile) { return tile->rangesAreSampled; });
  for (std::size_t c = 0; c < whole.schema.size(); ++c)
  {
    whole.ranges.push_back(emptyRange(whole.schema[c]));
    for (std::size_t t = 0; t < tiles.size(); ++t)
    {
      if (tiles[t]->pointCount > 0)
      {
        addRange(whole.ranges[c], (*columns)[t].range(*tiles[t].is, c, whole.schema[c]));
      }
    }
  }
  whole.computed = computedColumns(whole, tiles);
  std::vector<std::vector<std::uint16_t>> layers = addLayers(whole, tiles);
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    result.parts.push_back(
      { std::move((*columns)[t]), TilePlacing(tiles[t]->grid, whole.grid), std::move(layers[t]) });
  }
  return result;
}

/// The part of a store without points: none of its nodes is ever asked for.
TileDescription::Part partWithoutPoints(const StoreDescription& tile, const StoreDescription& whole)
{
  return { TileColumns(tile.schema, std::vector<ColumnMapping>(whole.schema.size())),
    TilePlacing(tile.grid, whole.grid), std::vector<std::uint16_t>(tile.layers.size()) };
}
} // namespace

std::string projectionOf(const StoreDescription& store)
{
  std::string text = store.crsWkt;
  for (const MetadataRecord& record : store.metadata)
  {
    if (store.crsWkt.empty() && record.owner == "LASF_Projection")
    {
      text.append(reinterpret_cast<const char*>(record.payload.data()), record.payload.size());
    }
  }
  return text;
}

Result<TileDescription> TileDescription::of(const std::string& path,
  const std::vector<const StoreDescription*>& tiles, std::vector<std::string> warnings)
{
  Tiles described;
  std::vector<QuantisationGrid> grids;
  for (const StoreDescription* const tile : tiles)
  {
    described.push_back({ tile, 1, diagonalOf(tile->bounds) });
    grids.push_back(tile->grid);
  }
  return describedOf(path, described, grids, std::move(warnings));
}

Result<TileDescription> TileDescription::ofStores(const std::string& path,
  const std::vector<const StoreDescription*>& tiles, std::vector<std::string> warnings)
{
  std::vector<const StoreDescription*> filled;
  std::copy_if(tiles.begin(), tiles.end(), std::back_inserter(filled),
    [](const StoreDescription* tile) { return tile->pointCount > 0; });
  if (filled.empty() || filled.size() == tiles.size())
  {
    return of(path, tiles, std::move(warnings));
  }
  Result<TileDescription> described = of(path, filled, std::move(warnings));
  if (!described)
  {
    return described;
  }
  TileDescription all;
  all.whole = std::move(described->whole);
  auto next = std::make_move_iterator(described->parts.begin());
  for (const StoreDescription* const tile : tiles)
  {
    if (tile->pointCount > 0)
    {
      all.parts.push_back(*next++);
      continue;
    }
    all.whole.fileBytes += tile->fileBytes;
    all.parts.push_back(partWithoutPoints(*tile, all.whole));
  }
  return all;
}

Result<TileDescription> TileDescription::of(const std::string& path,
  const std::vector<AlikeTiles>& kinds, const std::vector<QuantisationGrid>& grids,
  std::vector<std::string> warnings)
{
  Tiles described;
  for (const AlikeTiles& kind : kinds)
  {
    described.push_back({ &kind.together, kind.count, kind.lengths });
  }
  return describedOf(path, described, grids, std::move(warnings));
}

} // namespace pointfront
