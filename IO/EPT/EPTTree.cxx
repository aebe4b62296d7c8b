#include "EPTTree.h"

#include "EPTFolder.h"
#include "EPTSource.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/InPlace/ForeignTree.h"
#include "pointfront/Points/DescribedSource.h"

#include <cstdio>
#include <filesystem>
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

class EPTNodes final : public ForeignNodes
{
public:
  EPTNodes(std::shared_ptr<const EPTNodeDecoder> decoder, std::shared_ptr<const EPTFolder> tree)
    : decoder_(std::move(decoder))
    , tree_(std::move(tree))
  {
  }
  Result<RawBytes> fetch(std::uint64_t chunk) const override { return tree_->readNode(chunk); }
  std::vector<Result<RawBytes>> fetchAll(
    const std::vector<std::uint64_t>& chunks, const ReadStop& stop) const override
  {
    return tree_->readNodes(chunks, stop);
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
  std::size_t storedBytes(std::uint64_t chunk) const override
  {
    if (isAddress(tree_->place))
    {
      return 0;
    }
    std::error_code failure;
    const std::uintmax_t bytes = fs::file_size(tree_->fileOf(chunk), failure);
    return failure ? 0 : static_cast<std::size_t>(bytes);
  }
  Result<void> decode(const Part& part, const RawBytes& bytes, PointBatch& batch) const override
  {
    return decoder_->decode(part.chunk, bytes, batch);
  }
  std::vector<std::string> files() const override
  {
    std::vector<std::string> all{ tree_->path };
    for (std::uint64_t chunk = 0; chunk < tree_->nodes.size(); ++chunk)
    {
      all.push_back(tree_->fileOf(chunk));
    }
    return all;
  }

private:
  std::shared_ptr<const EPTNodeDecoder> decoder_;
  std::shared_ptr<const EPTFolder> tree_;
};

ForeignNode cellOf(const EPTNode& node, std::uint64_t chunk)
{
  ForeignNode cell;
  long long level = -1, x = -1, y = -1, z = -1; // a key that is no cell: the tree refuses it
  std::sscanf(node.key.c_str(), "%lld-%lld-%lld-%lld", &level, &x, &y, &z);
  const auto number = [](long long value)
  { return value >= 0 && value <= INT32_MAX ? static_cast<std::int32_t>(value) : -1; };
  cell.level = number(level);
  cell.x = number(x);
  cell.y = number(y);
  cell.z = number(z);
  cell.points = node.points;
  cell.chunk = chunk;
  return cell;
}

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

Result<std::shared_ptr<const StoredCloud>> EPTTreeFormat::open(const std::string& named) const
{
  const std::string path = descriptionOf(named);
  const Result<std::shared_ptr<const EPTFolder>> opened = EPTFolder::open(path);
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
  for (std::uint64_t chunk = 0; chunk < tree->nodes.size(); ++chunk)
  {
    content.nodes.push_back(cellOf(tree->nodes[static_cast<std::size_t>(chunk)], chunk));
    content.fileBytes += reader->storedBytes(chunk);
  }
  content.reader = reader;
  return ForeignTree::make(std::move(content));
}

} // namespace pointfront
