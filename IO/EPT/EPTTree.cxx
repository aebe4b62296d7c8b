#include "EPTTree.h"

#include "EPTFolder.h"
#include "EPTSource.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/InPlace/ForeignTree.h"
#include "pointfront/Points/DescribedSource.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

constexpr unsigned batchesAtOnce = 3;

std::string descriptionOf(const std::string& path)
{
  std::error_code failure;
  return fs::is_directory(path, failure) ? (fs::path(path) / "ept.json").string() : path;
}

std::string keyOf(const ForeignNode& node)
{
  return std::to_string(node.level) + "-" + std::to_string(node.x) + "-" + std::to_string(node.y) +
    "-" + std::to_string(node.z);
}

ForeignNode cellOf(const std::string& key, std::uint32_t points)
{
  ForeignNode cell;
  long long level = -1, x = -1, y = -1, z = -1; // a key that is no cell: the tree refuses it
  std::sscanf(key.c_str(), "%lld-%lld-%lld-%lld", &level, &x, &y, &z);
  const auto number = [](long long value)
  { return value >= 0 && value <= INT32_MAX ? static_cast<std::int32_t>(value) : -1; };
  cell.level = number(level);
  cell.x = number(x);
  cell.y = number(y);
  cell.z = number(z);
  cell.points = points;
  return cell;
}

ForeignPage pageOf(const EPTPage& page)
{
  ForeignPage found;
  for (const auto& [key, count] : page)
  {
    if (count != 0)
    {
      const auto points = static_cast<std::uint32_t>(std::max<std::int64_t>(count, 0));
      (count < 0 ? found.pages : found.nodes).push_back(cellOf(key, points));
    }
  }
  return found;
}

class EPTNodes final : public ForeignNodes
{
public:
  EPTNodes(std::shared_ptr<const EPTNodeDecoder> decoder, std::shared_ptr<const EPTFolder> tree)
    : decoder_(std::move(decoder))
    , tree_(std::move(tree))
  {
  }
  Result<RawBytes> fetch(const ForeignNode& node) const override
  {
    return tree_->readNode(nodeOf(node));
  }
  std::vector<Result<RawBytes>> fetchAll(
    const std::vector<ForeignNode>& nodes, const ReadStop& stop) const override
  {
    std::vector<EPTNode> wanted;
    std::transform(nodes.begin(), nodes.end(), std::back_inserter(wanted), nodeOf);
    return tree_->readNodes(wanted, stop);
  }
  std::vector<Result<ForeignPage>> readPages(const std::vector<ForeignNode>& wanted) const override
  {
    std::vector<std::string> keys;
    std::transform(wanted.begin(), wanted.end(), std::back_inserter(keys), keyOf);
    std::vector<Result<ForeignPage>> pages;
    for (const Result<EPTPage>& page : readEPTPages(tree_->place, keys))
    {
      pages.push_back(page ? pageOf(*page) : Result<ForeignPage>(page.error()));
    }
    return pages;
  }
  std::uint64_t disk() const override { return tree_->source->device(); }
  /// Each node is a file: those of one batch are read beside each other, so a few batches are
  /// enough.
  ReadCost readCost() const override
  {
    ReadCost cost = tree_->source->cost();
    if (cost.far())
    {
      cost.readsAtOnce = batchesAtOnce;
    }
    return cost;
  }
  /// 0 of a far tree: each would be a round trip.
  std::size_t storedBytes(const ForeignNode& node) const override
  {
    if (isAddress(tree_->place))
    {
      return 0;
    }
    std::error_code failure;
    const std::uintmax_t bytes = fs::file_size(tree_->fileOf(nodeOf(node)), failure);
    return failure ? 0 : static_cast<std::size_t>(bytes);
  }
  Result<void> decode(const Part& part, const RawBytes& bytes, PointBatch& batch) const override
  {
    return decoder_->decode(nodeOf(part.node), bytes, batch);
  }
  /// Where not all nodes are known, all files that lie in its folders.
  std::vector<std::string> files() const override
  {
    std::vector<std::string> all{ tree_->path };
    for (const EPTNode& node : tree_->nodes)
    {
      all.push_back(tree_->fileOf(node));
    }
    if (tree_->pages.empty() || isAddress(tree_->place))
    {
      return all;
    }
    all.resize(1);
    for (const char* folder : { "ept-data", "ept-hierarchy" })
    {
      std::error_code failure;
      for (fs::directory_iterator file(beside(tree_->place, folder), failure), end; file != end;
           file.increment(failure))
      {
        all.push_back(file->path().string());
      }
    }
    return all;
  }

private:
  static EPTNode nodeOf(const ForeignNode& node) { return { keyOf(node), node.points }; }

  std::shared_ptr<const EPTNodeDecoder> decoder_;
  std::shared_ptr<const EPTFolder> tree_;
};

/// For floating point, as a build would choose it.
Result<void> giveGrid(
  const std::shared_ptr<const PointSource>& source, SourceDescription& description)
{
  if (description.grid)
  {
    return {};
  }
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(std::make_unique<DescribedSource>(source, source->description()));
  const Result<GridChoice> choice = chooseGrid(sources, std::nullopt);
  if (!choice)
  {
    return choice.error();
  }
  description.grid = choice->grid;
  description.warnings.insert(
    description.warnings.end(), choice->warnings.begin(), choice->warnings.end());
  return {};
}
} // namespace

bool EPTTreeFormat::accepts(const std::string& path) const
{
  std::error_code failure;
  const std::string description = descriptionOf(path);
  return fileNameOf(description) == "ept.json" &&
    (isAddress(description) || fs::is_regular_file(description, failure));
}

Result<std::shared_ptr<const StoredCloud>> EPTTreeFormat::openTree(
  const std::string& named, EPTDepth depth) const
{
  const std::string path = descriptionOf(named);
  const Result<std::shared_ptr<const EPTFolder>> opened = EPTFolder::open(path, depth);
  if (!opened)
  {
    return opened.error();
  }
  const std::shared_ptr<const EPTFolder>& tree = *opened;
  const Result<std::shared_ptr<const EPTNodeDecoder>> nodes = EPTFormat(openNode_).decoderOf(tree);
  if (!nodes)
  {
    return nodes.error();
  }
  const EPTDescription& description = tree->description;
  ForeignTreeContent content;
  content.setCube(description.cube);
  content.spacing = description.ticks > 0.0 ? content.side / description.ticks : 0.0;
  content.source = EPTFormat::describe(**nodes, *tree);
  const auto points = std::make_shared<const EPTSource>(tree, *nodes, content.source);
  if (Result<void> ready = giveGrid(points, content.source); !ready)
  {
    return ready.error();
  }
  const auto reader = std::make_shared<const EPTNodes>(*nodes, tree);
  content.fileBytes = tree->descriptionBytes;
  for (const EPTNode& node : tree->nodes)
  {
    content.first.nodes.push_back(cellOf(node.key, node.points));
    content.fileBytes += reader->storedBytes(content.first.nodes.back());
  }
  for (const std::string& key : tree->pages)
  {
    content.first.pages.push_back(cellOf(key, 0));
  }
  content.fileBytes = tree->pages.empty() ? content.fileBytes : 0; // not known
  content.reader = reader;
  return ForeignTree::make(std::move(content));
}

} // namespace pointfront
