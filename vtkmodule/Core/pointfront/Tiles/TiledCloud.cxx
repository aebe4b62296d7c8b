#include "pointfront/Tiles/TiledCloud.h"

#include "pointfront/Ingest/CommonRadii.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Statistics/ColumnStatistics.h"
#include "pointfront/Store/StoredCloudFormats.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

namespace pointfront
{
namespace
{
/// What commonSchema() asks a source for.
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

/// A quotient so near to an integer is one: scales and offsets are decimal fractions.
std::optional<std::int64_t> wholeNumber(double value)
{
  constexpr double tolerance = 1e-6;
  constexpr double most = 4503599627370496.0; // 2^52
  const double nearest = std::round(value);
  return std::abs(value - nearest) <= tolerance && std::abs(nearest) <= most
    ? std::optional<std::int64_t>(static_cast<std::int64_t>(nearest))
    : std::nullopt;
}

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

/// Of a converted column, in the values of the common one.
ColumnRange converted(const ColumnRange& range, const Attribute& from, const Attribute& to)
{
  ColumnRange result = range;
  for (std::array<double, 2>& ends : result.components)
  {
    if (from.scale != to.scale || from.offset != to.offset)
    {
      ends = { ends[0] * from.scale + from.offset, ends[1] * from.scale + from.offset };
      std::sort(ends.begin(), ends.end());
    }
  }
  return result;
}

/// Each tile holds a file open for reading.
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
} // namespace

Result<std::shared_ptr<const StoredCloud>> TiledCloud::open(
  const std::string& path, const std::vector<std::string>& files, std::vector<std::string> warnings)
{
  raiseOpenFiles(files.size());
  std::vector<Result<std::shared_ptr<const StoredCloud>>> opened(
    files.size(), makeError(Error::Kind::NotFound, ""));
  ThreadCrew::ofProcess().run(files.size(),
    [&](std::size_t i, unsigned) { opened[i] = StoredCloudFormats::ofProcess().open(files[i]); });
  constexpr std::size_t mostNamed = 3;
  std::string faults;
  std::size_t faulty = 0;
  const Error* first = nullptr;
  Tiles tiles;
  for (auto& tile : opened)
  {
    if (tile)
    {
      tiles.push_back(std::move(*tile));
      continue;
    }
    first = first == nullptr ? &tile.error() : first;
    faults += ++faulty > mostNamed ? "" : (faults.empty() ? "" : "; ") + tile.error().what;
  }
  if (faulty > 0)
  {
    return makeError(first->kind,
      path + ": " + countOf(faulty, files.size()) + " cannot be opened: " + faults +
        (faulty > mostNamed ? "; and others" : ""));
  }
  return make(path, std::move(tiles), std::move(warnings));
}

Result<std::shared_ptr<const StoredCloud>> TiledCloud::make(
  const std::string& path, Tiles tiles, std::vector<std::string> warnings)
{
  if (tiles.empty())
  {
    return makeError(Error::Kind::BadArgument, path + ": names no store");
  }
  std::shared_ptr<TiledCloud> cloud(new TiledCloud);
  for (auto& tile : tiles)
  {
    cloud->tiles_.push_back({ std::move(tile), {}, {}, {} });
  }
  if (Result<void> done = cloud->describe(path, std::move(warnings)); !done)
  {
    return done.error();
  }
  return std::shared_ptr<const StoredCloud>(std::move(cloud));
}

Result<void> TiledCloud::describe(const std::string& path, std::vector<std::string> warnings)
{
  const StoreDescription& first = tiles_.front().cloud->description();
  description_.path = path;
  description_.structure = "tiles";
  description_.version = first.version;
  description_.refinement = first.refinement;
  description_.crsWkt = first.crsWkt;
  description_.metadata = first.metadata;
  description_.generator = first.generator;
  description_.warnings = std::move(warnings);
  for (const Tile& tile : tiles_)
  {
    const StoreDescription& own = tile.cloud->description();
    if (own.refinement != first.refinement)
    {
      return makeError(Error::Kind::BadArgument,
        path + ": '" + own.path + "' and '" + first.path +
          "' are refined in different ways (add and replace); they cannot be drawn as one cloud: "
          "build them alike, or open them as separate clouds");
    }
    description_.fileBytes += own.fileBytes;
    description_.pointCount += own.pointCount;
    description_.bounds.add(own.bounds);
    description_.levels = std::max(description_.levels, own.levels);
    description_.splatRadiusBase = std::max(description_.splatRadiusBase, own.splatRadiusBase);
  }
  if (Result<void> done = chooseColumns(); !done)
  {
    return makeError(done.error().kind, path + ": " + done.error().what);
  }
  chooseGrid();
  compareSystems();
  for (const Tile& tile : tiles_)
  {
    addRanges(tile);
  }
  return makeTable();
}

Result<void> TiledCloud::chooseColumns()
{
  std::vector<std::unique_ptr<PointSource>> sources;
  for (const Tile& tile : tiles_)
  {
    sources.push_back(std::make_unique<DescribedTile>(tile.cloud->description()));
  }
  Result<CommonSchema> common = commonSchema(sources, std::nullopt);
  if (!common)
  {
    return common.error();
  }
  description_.schema = std::move(common->schema);
  for (std::size_t t = 0; t < tiles_.size(); ++t)
  {
    tiles_[t].columns = std::move(common->mappings[t]);
  }
  std::map<std::size_t, std::string> lacked; // how many stores lack which
  for (std::size_t c = 0; c < description_.schema.size(); ++c)
  {
    const Attribute& attribute = description_.schema[c];
    description_.ranges.push_back(emptyRange(attribute));
    std::size_t lacking = 0;
    std::size_t differing = 0;
    for (const Tile& tile : tiles_)
    {
      lacking += tile.columns[c].column ? 0 : 1;
      differing += tile.columns[c].converted ? 1 : 0;
    }
    if (lacking > 0)
    {
      std::string& names = lacked[lacking];
      names += (names.empty() ? "" : ", ") + attribute.name;
    }
    if (differing > 0)
    {
      description_.warnings.push_back("The attribute '" + attribute.name + "' is taken as " +
        std::string(nameOf(attribute.type)) + ", because its type or scale differs in " +
        countOf(differing, tiles_.size()) + ".");
    }
  }
  for (const auto& [lacking, names] : lacked)
  {
    description_.warnings.push_back(
      countOf(lacking, tiles_.size()) + " lack " + names + "; zeros are shown for their points.");
  }
  const auto radius = description_.schema.find(splatRadiusAttribute);
  for (Tile& tile : tiles_)
  {
    const double base = tile.cloud->description().splatRadiusBase;
    if (radius && tile.columns[*radius].column && base != description_.splatRadiusBase)
    {
      tile.radii = recodedRadii(base, description_.splatRadiusBase);
    }
  }
  return {};
}

void TiledCloud::chooseGrid()
{
  QuantisationGrid& grid = description_.grid;
  grid = tiles_.front().cloud->description().grid;
  for (const Tile& tile : tiles_)
  {
    const QuantisationGrid& own = tile.cloud->description().grid;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (own.scale[axis] < grid.scale[axis] * (1.0 - 1e-9))
      {
        grid.scale[axis] = own.scale[axis];
        grid.offset[axis] = own.offset[axis];
      }
    }
  }
  std::size_t rounded = 0;
  for (Tile& tile : tiles_)
  {
    const QuantisationGrid& own = tile.cloud->description().grid;
    Tile::Placing placing;
    bool lies = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto ratio = wholeNumber(own.scale[axis] / grid.scale[axis]);
      const auto shift = wholeNumber((own.offset[axis] - grid.offset[axis]) / grid.scale[axis]);
      lies = lies && ratio && *ratio > 0 && shift;
      placing.ratio[axis] = ratio.value_or(1);
      placing.shift[axis] = shift.value_or(0);
    }
    if (lies)
    {
      tile.placing = placing;
    }
    rounded += lies ? 0 : 1;
  }
  if (rounded > 0)
  {
    char text[160];
    std::snprintf(text, sizeof text,
      " do not lie on the grid of the finest; their points are rounded, by at most %.9g, %.9g, "
      "%.9g units.",
      0.5 * grid.scale.x, 0.5 * grid.scale.y, 0.5 * grid.scale.z);
    description_.warnings.push_back(countOf(rounded, tiles_.size()) + text);
  }
}

void TiledCloud::compareSystems()
{
  std::string known;
  std::string knownOf;
  std::string differing;
  std::size_t different = 0;
  std::size_t silent = 0;
  for (const Tile& tile : tiles_)
  {
    const StoreDescription& store = tile.cloud->description();
    const std::string system = projectionOf(store);
    if (system.empty())
    {
      ++silent;
    }
    else if (known.empty())
    {
      known = system;
      knownOf = store.path;
      description_.crsWkt = store.crsWkt;
      description_.metadata = store.metadata;
    }
    else if (system != known)
    {
      differing = ++different == 1 ? store.path : differing;
    }
  }
  if (different > 0)
  {
    description_.warnings.push_back(countOf(different, tiles_.size()) +
      " name another coordinate reference system than '" + knownOf + "', the first '" + differing +
      "': unless both mean the same, they do not lie where they should; build them with one "
      "--crs.");
  }
  if (silent > 0 && !known.empty())
  {
    description_.warnings.push_back(countOf(silent, tiles_.size()) +
      " name no coordinate reference system; they are taken to be in that of '" + knownOf + "'.");
  }
}

void TiledCloud::addRanges(const Tile& tile)
{
  const StoreDescription& own = tile.cloud->description();
  for (std::size_t c = 0; c < description_.schema.size(); ++c)
  {
    const Attribute& common = description_.schema[c];
    const ColumnMapping& mapping = tile.columns[c];
    if (!mapping.column)
    {
      const std::vector<std::byte> zero(common.bytes());
      addRange(description_.ranges[c], rangeOf(zero.data(), common, 1));
    }
    else if (*mapping.column < own.ranges.size())
    {
      const ColumnRange& range = own.ranges[*mapping.column];
      addRange(description_.ranges[c],
        mapping.converted ? converted(range, own.schema[*mapping.column], common) : range);
    }
  }
}

Result<void> TiledCloud::makeTable()
{
  std::map<std::pair<std::uint16_t, std::string>, Layer> layers;
  std::uint64_t nodes = 0;
  for (const Tile& tile : tiles_)
  {
    nodes += tile.cloud->hierarchy()->nodeCount();
    for (const Layer& layer : tile.cloud->description().layers)
    {
      Layer& common = layers[{ layer.objectClass, layer.name }];
      common.objectClass = layer.objectClass;
      common.name = layer.name;
      common.pointCount += layer.pointCount;
      common.nodeCount += layer.nodeCount;
    }
  }
  if (nodes >= noNode)
  {
    return makeError(Error::Kind::NoMemory,
      description_.path + ": its stores have " + std::to_string(nodes) +
        " nodes together, more than 32 bits count; open fewer of them");
  }
  std::map<std::pair<std::uint16_t, std::string>, std::uint16_t> numbers;
  for (auto& [key, layer] : layers)
  {
    numbers[key] = static_cast<std::uint16_t>(description_.layers.size());
    description_.layers.push_back(layer);
  }
  if (layers.size() > 1 && layers.count({ 0, "all" }) > 0)
  {
    description_.warnings.push_back(
      "Some stores have a tree for each class and others one for all "
      "points: what is said of a class does not reach the latter's points.");
  }
  std::vector<TileTable::Tile> tables;
  for (const Tile& tile : tiles_)
  {
    const Hierarchy& hierarchy = *tile.cloud->hierarchy();
    TileTable::Tile row{ tile.cloud->hierarchy(), {}, 0 };
    for (const Layer& layer : tile.cloud->description().layers)
    {
      row.layers.push_back(numbers[{ layer.objectClass, layer.name }]);
    }
    if (const NodeIndex count = hierarchy.nodeCount(); count > 0)
    {
      const Node last = hierarchy.node(count - 1);
      row.points = last.firstPoint + last.pointCount;
    }
    if (const std::optional<Error> fault = hierarchy.fault())
    {
      return *fault;
    }
    tables.push_back(std::move(row));
  }
  table_ = std::make_shared<const TileTable>(std::move(tables));
  hierarchy_ = table_;
  return {};
}

std::vector<std::string> TiledCloud::files() const
{
  std::vector<std::string> all{ description_.path };
  for (const Tile& tile : tiles_)
  {
    const std::vector<std::string> own = tile.cloud->files();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

ColumnSelection TiledCloud::ownColumns(const Tile& tile, const ColumnSelection& columns)
{
  ColumnSelection own;
  for (const std::uint32_t column : columns)
  {
    if (const auto there = tile.columns[column].column)
    {
      own.push_back(static_cast<std::uint32_t>(*there));
    }
  }
  std::sort(own.begin(), own.end());
  return own;
}

std::size_t TiledCloud::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, description_.schema);
}

std::size_t TiledCloud::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const TileTable::Place at = table_->placeOf(node);
  const Tile& tile = tiles_[at.tile];
  return tile.cloud->storedBytes(at.node, ownColumns(tile, columns));
}

Result<FetchedNode> TiledCloud::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  const TileTable::Place at = table_->placeOf(node);
  const Tile& tile = tiles_[at.tile];
  Result<FetchedNode> inner = tile.cloud->fetch(at.node, ownColumns(tile, columns));
  if (!inner)
  {
    return inner;
  }
  FetchedNode fetched{ node, columns, {}, inner->bytesRead, table_->shifted(at.tile, inner->row) };
  fetched.inner = std::make_shared<const FetchedNode>(std::move(*inner));
  return fetched;
}

/// Positions of a tile's node onto the common grid.
Result<void> TiledCloud::place(const Tile& tile, NodeColumns& node) const
{
  if (tile.placing && tile.placing->ratio == GridPosition(1))
  {
    node.origin += tile.placing->shift;
    return {};
  }
  const QuantisationGrid& own = tile.cloud->description().grid;
  std::vector<GridPosition> steps(node.positions.size());
  GridPosition low(std::numeric_limits<std::int64_t>::max());
  GridPosition high(std::numeric_limits<std::int64_t>::min());
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const GridPosition position = node.origin + GridPosition(node.positions[i]);
    steps[i] = tile.placing ? position * tile.placing->ratio + tile.placing->shift
                            : description_.grid.toGrid(own.toWorld(position));
    low = glm::min(low, steps[i]);
    high = glm::max(high, steps[i]);
  }
  if (steps.empty())
  {
    return {};
  }
  const GridPosition extent = high - low;
  if (std::max({ extent.x, extent.y, extent.z }) > std::numeric_limits<std::uint32_t>::max())
  {
    return makeError(Error::Kind::Unsupported,
      tile.cloud->description().path +
        ": a node of it is wider than 32 bits of steps of the "
        "finest store beside it; build them with one --precision");
  }
  node.origin = low;
  std::transform(steps.begin(), steps.end(), node.positions.begin(),
    [&low](const GridPosition& step) { return glm::u32vec3(step - low); });
  return {};
}

Result<NodeColumns> TiledCloud::decode(const FetchedNode& fetched) const
{
  const TileTable::Place at = table_->placeOf(fetched.node);
  const Tile& tile = tiles_[at.tile];
  Result<NodeColumns> inner = tile.cloud->decode(*fetched.inner);
  if (!inner)
  {
    return inner;
  }
  NodeColumns result = std::move(*inner);
  const AttributeSchema& own = tile.cloud->description().schema;
  const std::size_t points = result.size();
  std::vector<std::vector<std::byte>> columns;
  for (const std::uint32_t column : fetched.columns)
  {
    const Attribute& common = description_.schema[column];
    const ColumnMapping& mapping = tile.columns[column];
    if (!mapping.column)
    {
      columns.emplace_back(points * common.bytes());
      continue;
    }
    const auto place =
      std::find(result.selection.begin(), result.selection.end(), std::uint32_t(*mapping.column));
    std::vector<std::byte>& values =
      result.columns[static_cast<std::size_t>(place - result.selection.begin())];
    if (mapping.converted)
    {
      columns.emplace_back(points * common.bytes());
      convertColumn(own[*mapping.column], values.data(), common, columns.back().data(), points);
      continue;
    }
    if (tile.radii && common.name == splatRadiusAttribute)
    {
      std::transform(values.begin(), values.end(), values.begin(),
        [&tile](std::byte code) { return (*tile.radii)[std::to_integer<std::size_t>(code)]; });
    }
    columns.push_back(std::move(values));
  }
  result.node = fetched.node;
  result.describe(fetched.row);
  result.selection = fetched.columns;
  result.columns = std::move(columns);
  if (Result<void> placed = place(tile, result); !placed)
  {
    return placed.error();
  }
  return result;
}

Result<VerifyReport> TiledCloud::verify(const ProgressFunction& progress) const
{
  VerifyReport all;
  for (const Tile& tile : tiles_)
  {
    const Result<VerifyReport> own = tile.cloud->verify(progress);
    if (!own)
    {
      return own;
    }
    all.nodesChecked += own->nodesChecked;
    all.pointsChecked += own->pointsChecked;
    if (!own->ok)
    {
      all.ok = false;
      all.firstError = own->firstError;
      return all;
    }
  }
  return all;
}

} // namespace pointfront
