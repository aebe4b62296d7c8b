#include "pointfront/Collection/CollectionState.h"

#include "pointfront/Collection/HeadTable.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/StoreAssembly.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
/// One tile's part of the overview: not so many that few tiles already make large groups.
HeadSizes sizesFor(std::size_t tiles, std::uint64_t overviewPoints)
{
  constexpr std::uint64_t fewest = 64;
  constexpr std::uint64_t most = 2048;
  const std::uint64_t share = overviewPoints / std::max<std::size_t>(tiles, 1);
  return { static_cast<std::uint32_t>(std::clamp(share, fewest, most)) };
}

/// A cloud without points, for its attributes, its grid and the depth of its colours.
StoreDescription emptied(StoreDescription whole)
{
  whole.pointCount = 0;
  whole.wholeCount = 0;
  whole.fileBytes = 0;
  whole.levels = 0;
  whole.bounds = Bounds();
  whole.layers.clear();
  whole.warnings.clear();
  for (std::size_t c = 0; c < whole.schema.size(); ++c)
  {
    const bool tellsDepth = whole.schema[c].name == "rgb";
    whole.ranges[c] = tellsDepth ? whole.ranges[c] : emptyRange(whole.schema[c]);
  }
  return whole;
}

/// The whole alone does not say whether small colours have 16 bits; its tiles do.
HeldColours coloursOf(const CollectionRecord& record)
{
  HeldColours held = heldColours(record.whole);
  for (std::size_t t = 0; t < record.tiles.size() && held == HeldColours::Eight; ++t)
  {
    held =
      heldColours(record.description(t, "")) == HeldColours::Sixteen ? HeldColours::Sixteen : held;
  }
  return held;
}

bool codedAlike(const StoreDescription& a, const StoreDescription& b)
{
  return a.schema == b.schema && a.grid == b.grid && a.splatRadiusBase == b.splatRadiusBase;
}
} // namespace

CollectionState::CollectionState(std::string path, std::shared_ptr<const PointStore> before,
  std::optional<CollectionRecord> record)
  : path_(std::move(path))
  , before_(std::move(before))
  , last_(std::move(record))
{
  if (last_)
  {
    next_.state = last_->state;
    next_.nextId = last_->nextId;
    next_.kinds = last_->kinds;
    next_.history = std::move(last_->history);
    lastColours_ = coloursOf(*last_);
  }
}

void CollectionState::takeTiles(std::vector<IncomingTile>& added, const CollectionOptions& options)
{
  const HeadSizes sizes = sizesFor(next_.tiles.size() + added.size(), options.overviewPoints);
  next_.tiles.reserve(next_.tiles.size() + added.size());
  for (IncomingTile& tile : added)
  {
    tile.is.id = tile.is.id == 0 ? next_.nextId++ : tile.is.id;
    CollectedTile facts = tile.facts(next_.kinds);
    chooseHeads(facts, sizes);
    next_.tiles.push_back(std::move(facts));
  }
}

/// How stored points become those of the next state, if they differ.
Result<void> CollectionState::chooseAdaption()
{
  const bool widened =
    lastColours_ == HeldColours::Eight && heldColours(next_.whole) == HeldColours::Sixteen;
  recoded_ = last_ && (widened || !codedAlike(next_.whole, last_->whole));
  if (!recoded_)
  {
    return {};
  }
  StoreDescription before = last_->whole;
  before.structure = lastColours_ == HeldColours::Sixteen ? "octree" : before.structure;
  Result<TileDescription> adaption = TileDescription::of(path_, { &next_.whole, &before }, {});
  if (!adaption)
  {
    return adaption.error();
  }
  adaption_ = std::make_unique<TileDescription>(std::move(*adaption));
  return {};
}

/// Describes all tiles together, as the next state shows them. The parts of the last `added`.
Result<std::vector<TileDescription::Part>> CollectionState::describe(std::size_t added)
{
  std::vector<std::size_t> places;
  std::vector<AlikeTiles> alike = next_.alikeTiles(std::nullopt, places);
  std::vector<QuantisationGrid> grids;
  grids.reserve(next_.tiles.size() + 1);
  for (const CollectedTile& tile : next_.tiles)
  {
    grids.push_back(tile.grid);
  }
  Result<TileDescription> described = TileDescription::of(path_, alike, grids, {});
  const bool wasDeep = last_ && heldColours(last_->whole) == HeldColours::Sixteen;
  if (described && last_ &&
    (!codedAlike(described->whole, last_->whole) ||
      (wasDeep && heldColours(described->whole) != HeldColours::Sixteen)))
  {
    // The heads keep what they have: fewer attributes, a coarser grid, or colours that are not
    // widened any more, come with `compact`.
    std::vector<std::string> warnings = std::move(described->whole.warnings);
    AlikeTiles known;
    known.begin(emptied(last_->whole));
    alike.insert(alike.begin(), std::move(known));
    grids.insert(grids.begin(), last_->whole.grid);
    described = TileDescription::of(path_, alike, grids, {});
    if (described)
    {
      described->whole.warnings = std::move(warnings);
      described->parts.erase(described->parts.begin());
    }
  }
  if (!described)
  {
    return described.error();
  }
  next_.whole = std::move(described->whole);
  next_.whole.path.clear();
  next_.whole.structure = "collection";
  if (Result<void> done = chooseAdaption(); !done)
  {
    return done.error();
  }
  std::vector<TileDescription::Part> parts;
  for (auto tile = next_.tiles.end() - static_cast<std::ptrdiff_t>(added);
       tile != next_.tiles.end(); ++tile)
  {
    parts.push_back(described->parts[places[tile->kind]]);
    parts.back().placing = TilePlacing(tile->grid, next_.whole.grid);
  }
  return parts;
}

/// A node of the tree of heads of the state before, with all below it.
std::unique_ptr<HeadItem> CollectionState::storedItem(NodeIndex node) const
{
  const Hierarchy& table = *before_->hierarchy();
  const Node row = table.node(node);
  if (const auto& root = last_->heads[node].root)
  {
    const CollectedTile& tile = last_->tiles[root->first];
    return HeadItem::leafOf(tile.is.id, root->second, tile.roots[root->second].row);
  }
  auto item = std::make_unique<HeadItem>();
  item->stored = node;
  item->storedPoints = row.pointCount;
  item->children.reserve(row.childCount);
  for (std::uint32_t c = 0; c < row.childCount; ++c)
  {
    item->children.push_back(storedItem(row.firstChild + c));
  }
  item->addUp();
  return item;
}

Result<HeadPoints> CollectionState::load(const HeadItem& group) const
{
  ColumnSelection all(last_->whole.schema.size() + 1);
  std::iota(all.begin(), all.end(), 0);
  Result<NodeColumns> node = before_->read(group.stored, all);
  if (!node)
  {
    return node.error();
  }
  if (!recoded_)
  {
    return HeadPoints::of(*node, last_->whole.schema);
  }
  const TileDescription::Part& part = adaption_->parts[1];
  std::vector<std::byte> tiles = std::move(node->columns.back());
  node->columns.pop_back();
  node->selection.pop_back();
  ColumnSelection whole(next_.whole.schema.size());
  std::iota(whole.begin(), whole.end(), 0);
  part.columns.adapt(*node, whole, next_.whole.schema);
  if (Result<void> placed = part.placing.place(*node, path_); !placed)
  {
    return placed.error();
  }
  node->columns.push_back(std::move(tiles));
  return HeadPoints::of(*node, next_.whole.schema);
}

Result<void> CollectionState::openTrees()
{
  if (!before_)
  {
    return {};
  }
  if (last_->version == 1 && last_->epochs().size() > 1)
  {
    return makeError(Error::Kind::Unsupported,
      path_ +
        ": an older version wrote it, with several epochs in one tree; first let 'pointfront "
        "collection compact' make a tree of each");
  }
  const HeadTree::Load read = [this](const HeadItem& group) { return load(group); };
  const Hierarchy& table = *before_->hierarchy();
  for (const NodeIndex root : table.roots())
  {
    NodeIndex leaf = root; // its first one: all are of the same tree
    for (Node row = table.node(leaf); !last_->heads[leaf].root && !row.leaf();)
    {
      leaf = row.firstChild;
      row = table.node(leaf);
    }
    const auto& is = last_->heads[leaf].root;
    if (!is)
    {
      continue; // the fault of the table says why
    }
    const CollectedTile& tile = last_->tiles[is->first];
    trees_.emplace(last_->treeOf(tile, is->second), HeadTree(storedItem(root), read));
  }
  const std::optional<Error> fault = table.fault();
  return fault ? Result<void>(*fault) : Result<void>();
}

/// From the layers of the state before to those of the next.
void CollectionState::renameTrees()
{
  std::map<HeadTreeKey, HeadTree> named;
  for (auto& [key, tree] : trees_)
  {
    const Layer& known = last_->whole.layers[key.layer];
    const auto found = std::find_if(next_.whole.layers.begin(), next_.whole.layers.end(),
      [&](const Layer& layer)
      { return layer.objectClass == known.objectClass && layer.name == known.name; });
    // A layer that the next state lacks was that of removed tiles alone.
    const auto number = static_cast<std::uint16_t>(found - next_.whole.layers.begin());
    if (number < next_.whole.layers.size())
    {
      named.emplace(HeadTreeKey{ number, key.epoch }, std::move(tree));
    }
  }
  trees_ = std::move(named);
}

Result<void> CollectionState::insertHeads(const std::vector<IncomingTile>& added,
  const std::vector<TileDescription::Part>& parts, const CollectionOptions& options)
{
  const std::size_t first = next_.tiles.size() - added.size();
  std::vector<std::optional<Error>> faults(added.size());
  std::vector<std::vector<TileHead>> heads(added.size());
  ThreadCrew::ofProcess().run(added.size(),
    [&](std::size_t i, unsigned)
    {
      auto own = readHeads(added[i], next_.tiles[first + i].roots, parts[i], next_.whole.schema);
      if (own)
      {
        heads[i] = std::move(*own);
      }
      else
      {
        faults[i] = own.error();
      }
    });
  std::map<HeadTreeKey, std::vector<TileHead>> byTree;
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    if (faults[i])
    {
      return *faults[i];
    }
    for (TileHead& head : heads[i])
    {
      byTree[next_.treeOf(next_.tiles[first + i], head.leaf->root)].push_back(std::move(head));
    }
  }
  if (options.progress && !options.progress({ "writing", 0, 0, 0.75, 0.0 }))
  {
    return makeError(Error::Kind::Cancelled, "cancelled");
  }
  const HeadTree::Load load = [this](const HeadItem& group) { return this->load(group); };
  for (auto& [key, own] : byTree)
  {
    HeadTree& tree = trees_.try_emplace(key, load).first->second;
    if (tree.root() == nullptr)
    {
      tree.build(std::move(own));
      continue;
    }
    for (TileHead& head : own)
    {
      if (Result<void> done = tree.insert(std::move(head)); !done)
      {
        return done;
      }
    }
  }
  return {};
}

Result<void> CollectionState::change(const std::unordered_set<std::uint32_t>& removed,
  std::vector<IncomingTile> added, const CollectionOptions& options)
{
  if (Result<void> opened = openTrees(); !opened)
  {
    return opened;
  }
  if (last_)
  {
    next_.tiles = std::move(last_->tiles);
  }
  next_.tiles.erase(std::remove_if(next_.tiles.begin(), next_.tiles.end(),
                      [&](const CollectedTile& tile) { return removed.count(tile.is.id) > 0; }),
    next_.tiles.end());
  takeTiles(added, options);
  if (next_.tiles.empty())
  {
    return makeError(Error::Kind::BadArgument,
      path_ + ": would have no tile left; delete the file if that is meant");
  }
  Result<std::vector<TileDescription::Part>> parts = describe(added.size());
  if (!parts)
  {
    return parts.error();
  }
  renameTrees();
  Result<void> done;
  for (auto& [key, tree] : trees_)
  {
    done = done && !removed.empty() ? tree.remove(removed) : done;
    done = done && recoded_ ? tree.loadAll() : done;
  }
  done = done ? insertHeads(added, *parts, options) : done;
  ++next_.state;
  return done;
}

AttributeSchema CollectionState::headsSchema() const
{
  AttributeSchema schema = next_.whole.schema;
  schema.add({ tileColumn, ScalarType::UInt32, 1, 1.0, 0.0, "id of the tile" });
  return schema;
}

Result<CollectionReport> CollectionState::write(std::unique_ptr<OutputFile> file)
{
  const AttributeSchema schema = headsSchema();
  std::vector<const HeadItem*> roots;
  std::vector<Layer> layers; // the store's: one for each tree
  for (auto& [key, tree] : trees_)
  {
    if (tree.root() != nullptr)
    {
      roots.push_back(tree.root());
      layers.push_back(next_.whole.layers[key.layer]);
      layers.back().name += key.epoch.empty() ? "" : " of " + key.epoch;
    }
  }
  HeadTable table(roots);
  StoredHeads before;
  before.store = before_.get();
  before.facts = last_ ? std::move(last_->heads) : std::vector<HeadNode>();
  Result<std::unique_ptr<StoreWriter>> writer = assembleStore(std::move(file), schema);
  if (!writer)
  {
    return writer.error();
  }
  if (Result<void> done = table.append(**writer, schema, std::move(before), path_); !done)
  {
    return done.error();
  }
  next_.heads = table.takeFacts(next_.tiles);
  StoreDescription heads;
  heads.grid = next_.whole.grid;
  heads.crsWkt = next_.whole.crsWkt;
  heads.structure = "heads";
  heads.schema = schema;
  heads.generator = "pointfront " POINTFRONT_VERSION;
  heads.layers = std::move(layers);
  heads.splatRadiusBase = next_.whole.splatRadiusBase;
  heads.metadata.push_back({ collectionOwner, collectionId, "tiles", next_.encode() });
  if (Result<void> done =
        (*writer)->commit(std::move(heads), table.rows(), table.roots(), table.payloads());
      !done)
  {
    return done.error();
  }
  CollectionReport report;
  report.state = next_.state;
  report.tiles = next_.tiles.size();
  report.points = next_.whole.pointCount;
  report.headPoints = table.points();
  report.bytesWritten = (*writer)->bytesWritten();
  report.warnings = next_.whole.warnings;
  return report;
}

} // namespace pointfront
