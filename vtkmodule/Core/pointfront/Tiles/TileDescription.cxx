#include "pointfront/Tiles/TileDescription.h"

#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Store/ColumnStatistics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

namespace pointfront
{
namespace
{
using Tiles = std::vector<const StoreDescription*>;

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

std::string countOf(std::size_t some, std::size_t all)
{
  return std::to_string(some) + " of " + std::to_string(all) + " stores";
}

Result<void> addSums(StoreDescription& whole, const Tiles& tiles)
{
  const StoreDescription& first = *tiles.front();
  whole.structure = "tiles";
  whole.version = first.version;
  whole.refinement = first.refinement;
  whole.crsWkt = first.crsWkt;
  whole.metadata = first.metadata;
  whole.generator = first.generator;
  for (const StoreDescription* tile : tiles)
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
  for (const StoreDescription* tile : tiles)
  {
    sources.push_back(std::make_unique<DescribedTile>(*tile));
  }
  Result<CommonSchema> common = commonSchema(sources, std::nullopt);
  if (!common)
  {
    return makeError(common.error().kind, whole.path + ": " + common.error().what);
  }
  whole.schema = std::move(common->schema);
  const auto radius = whole.schema.find(splatRadiusAttribute);
  std::vector<TileColumns> columns;
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    columns.emplace_back(tiles[t]->schema, std::move(common->mappings[t]));
    const double base = tiles[t]->splatRadiusBase;
    if (radius && !columns.back().lacks(*radius) && base != whole.splatRadiusBase)
    {
      columns.back().recodeRadii(base, whole.splatRadiusBase);
    }
  }
  return columns;
}

void compareColumns(StoreDescription& whole, const std::vector<TileColumns>& columns)
{
  std::map<std::size_t, std::string> lacked; // how many stores lack which
  for (std::size_t c = 0; c < whole.schema.size(); ++c)
  {
    const Attribute& attribute = whole.schema[c];
    std::size_t lacking = 0;
    std::size_t differing = 0;
    for (const TileColumns& tile : columns)
    {
      lacking += tile.lacks(c) ? 1 : 0;
      differing += tile.converts(c) ? 1 : 0;
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
        countOf(differing, columns.size()) + ".");
    }
  }
  for (const auto& [lacking, names] : lacked)
  {
    whole.warnings.push_back(
      countOf(lacking, columns.size()) + " lack " + names + "; zeros are shown for their points.");
  }
}

/// Columns that no tile holds, and some tiles compute.
ColumnSelection computedColumns(const StoreDescription& whole, const Tiles& tiles)
{
  ColumnSelection computed;
  for (std::uint32_t c = 0; c < whole.schema.size(); ++c)
  {
    const bool held = std::any_of(tiles.begin(), tiles.end(),
      [&](const StoreDescription* tile)
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

std::vector<TilePlacing> chooseGrid(StoreDescription& whole, const Tiles& tiles)
{
  std::vector<QuantisationGrid> grids;
  for (const StoreDescription* tile : tiles)
  {
    grids.push_back(tile->grid);
  }
  whole.grid = TilePlacing::commonGrid(grids);
  std::vector<TilePlacing> placings;
  std::size_t rounded = 0;
  for (const QuantisationGrid& grid : grids)
  {
    placings.emplace_back(grid, whole.grid);
    rounded += placings.back().exact() ? 0 : 1;
  }
  if (rounded > 0)
  {
    char text[160];
    std::snprintf(text, sizeof text,
      " do not lie on the grid of the finest; their points are rounded, by at most %.9g, %.9g, "
      "%.9g units.",
      0.5 * whole.grid.scale.x, 0.5 * whole.grid.scale.y, 0.5 * whole.grid.scale.z);
    whole.warnings.push_back(countOf(rounded, tiles.size()) + text);
  }
  return placings;
}

void compareSystems(StoreDescription& whole, const Tiles& tiles)
{
  std::string known;
  std::string knownOf;
  std::string differing;
  std::size_t different = 0;
  std::size_t silent = 0;
  for (const StoreDescription* tile : tiles)
  {
    const std::string system = projectionOf(*tile);
    if (system.empty())
    {
      ++silent;
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
      differing = ++different == 1 ? tile->path : differing;
    }
  }
  if (different > 0)
  {
    whole.warnings.push_back(countOf(different, tiles.size()) +
      " name another coordinate reference system than '" + knownOf + "', the first '" + differing +
      "': unless both mean the same, they do not lie where they should; build them with one "
      "--crs.");
  }
  if (silent > 0 && !known.empty())
  {
    whole.warnings.push_back(countOf(silent, tiles.size()) +
      " name no coordinate reference system; they are taken to be in that of '" + knownOf + "'.");
  }
}

/// Tiles of a survey are neighbours; one that strayed makes all others small in a picture.
void compareDistances(StoreDescription& whole, const Tiles& tiles)
{
  constexpr double far = 10.0; // times all of them in a row
  double together = 0.0;
  for (const StoreDescription* tile : tiles)
  {
    together += tile->bounds.empty() ? 0.0 : glm::length(tile->bounds.size());
  }
  const double extent = whole.bounds.empty() ? 0.0 : glm::length(whole.bounds.size());
  if (together > 0.0 && extent > far * together)
  {
    char text[200];
    std::snprintf(text, sizeof text,
      "Its stores lie far apart: they extend over %.6g units, and in a row they would be %.6g "
      "units long; in a picture of all they are small.",
      extent, together);
    whole.warnings.push_back(text);
  }
}

/// Adds the layers of all tiles, in the order of their classes.
std::vector<std::vector<std::uint16_t>> addLayers(StoreDescription& whole, const Tiles& tiles)
{
  std::map<std::pair<std::uint16_t, std::string>, Layer> layers;
  for (const StoreDescription* tile : tiles)
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

Result<TileDescription> TileDescription::of(
  const std::string& path, const Tiles& tiles, std::vector<std::string> warnings)
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
  compareColumns(whole, *columns);
  std::vector<TilePlacing> placings = chooseGrid(whole, tiles);
  compareSystems(whole, tiles);
  compareDistances(whole, tiles);
  whole.rangesAreSampled = std::any_of(
    tiles.begin(), tiles.end(), [](const auto& tile) { return tile->rangesAreSampled; });
  for (std::size_t c = 0; c < whole.schema.size(); ++c)
  {
    whole.ranges.push_back(emptyRange(whole.schema[c]));
    for (std::size_t t = 0; t < tiles.size(); ++t)
    {
      addRange(whole.ranges[c], (*columns)[t].range(*tiles[t], c, whole.schema[c]));
    }
  }
  whole.computed = computedColumns(whole, tiles);
  std::vector<std::vector<std::uint16_t>> layers = addLayers(whole, tiles);
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    result.parts.push_back({ std::move((*columns)[t]), placings[t], std::move(layers[t]) });
  }
  return result;
}

} // namespace pointfront
