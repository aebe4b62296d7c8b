#include "EPTTree.h"

#include "EPTDescription.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Disk/InputFile.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/InPlace/ForeignTree.h"
#include "pointfront/Points/DescribedSource.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

std::string descriptionOf(const std::string& path)
{
  std::error_code failure;
  return fs::is_directory(path, failure) ? (fs::path(path) / "ept.json").string() : path;
}

/// The nodes of a source whose chunks they are.
class EPTNodes final : public ForeignNodes
{
public:
  EPTNodes(std::shared_ptr<const PointSource> source, std::string folder, std::string ending,
    std::vector<EPTNode> nodes)
    : source_(std::move(source))
    , folder_(std::move(folder))
    , ending_(std::move(ending))
    , nodes_(std::move(nodes))
  {
  }
  Result<RawBytes> fetch(std::uint64_t chunk) const override
  {
    const Result<std::unique_ptr<const InputFile>> file = InputFile::open(fileOf(chunk));
    if (!file)
    {
      return file.error();
    }
    RawBytes bytes(static_cast<std::size_t>((*file)->bytes()));
    if (Result<void> read = (*file)->readAt(0, bytes.data.get(), bytes.size); !read)
    {
      return read.error();
    }
    return bytes;
  }
  std::size_t storedBytes(std::uint64_t chunk) const override
  {
    std::error_code failure;
    const std::uintmax_t bytes = fs::file_size(fileOf(chunk), failure);
    return failure ? 0 : static_cast<std::size_t>(bytes);
  }
  Result<void> decode(const Part& part, const RawBytes&, PointBatch& batch) const override
  {
    return source_->read(part.chunk, batch);
  }
  std::vector<std::string> files() const override
  {
    std::vector<std::string> all{ source_->description().path };
    for (std::uint64_t chunk = 0; chunk < nodes_.size(); ++chunk)
    {
      all.push_back(fileOf(chunk));
    }
    return all;
  }

private:
  std::string fileOf(std::uint64_t chunk) const
  {
    return folder_ + "/ept-data/" + nodes_[static_cast<std::size_t>(chunk)].key + ending_;
  }

  std::shared_ptr<const PointSource> source_;
  std::string folder_;
  std::string ending_;
  std::vector<EPTNode> nodes_;
};

ForeignNode cellOf(const EPTNode& node, std::uint64_t chunk)
{
  ForeignNode cell;
  long long level = -1, x = -1, y = -1, z = -1; // of a key that is no cell: refused by the tree
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
  return fs::path(description).filename() == "ept.json" &&
    fs::is_regular_file(description, failure);
}

Result<std::shared_ptr<const StoredCloud>> EPTTreeFormat::open(const std::string& named) const
{
  const std::string path = descriptionOf(named);
  const Result<MemoryMap> map = MemoryMap::open(path);
  if (!map)
  {
    return map.error();
  }
  const Result<EPTDescription> tree =
    EPTDescription::parse({ reinterpret_cast<const char*>(map->data()), map->size() }, path);
  if (!tree)
  {
    return tree.error();
  }
  const std::string folder = fs::absolute(path).parent_path().string();
  Result<std::vector<EPTNode>> nodes = readEPTHierarchy(folder);
  if (!nodes)
  {
    return nodes.error();
  }
  Result<std::unique_ptr<PointSource>> source = EPTFormat(openNode_).open(path);
  if (!source)
  {
    return source.error();
  }
  const std::shared_ptr<const PointSource> points = std::move(*source);
  const glm::dvec3 sides = tree->cube.empty() ? glm::dvec3(0.0) : tree->cube.size();
  ForeignTreeContent content;
  content.side = std::max({ sides.x, sides.y, sides.z });
  content.low = tree->cube.empty() ? glm::dvec3(0.0) : tree->cube.low;
  content.spacing = tree->ticks > 0.0 ? content.side / tree->ticks : 0.0;
  content.source = points->description();
  if (Result<void> ready = giveGrid(points, content.source); !ready)
  {
    return ready.error();
  }
  content.fileBytes = map->size();
  for (std::uint64_t i = 0; i < nodes->size(); ++i)
  {
    content.nodes.push_back(cellOf((*nodes)[static_cast<std::size_t>(i)], i));
  }
  const char* const ending = tree->encoding == EPTEncoding::Laszip ? ".laz"
    : tree->encoding == EPTEncoding::Binary                        ? ".bin"
                                                                   : ".zst";
  std::vector<EPTNode> list = std::move(*nodes);
  auto reader = std::make_shared<EPTNodes>(points, folder, ending, std::move(list));
  for (std::uint64_t i = 0; i < content.nodes.size(); ++i)
  {
    content.fileBytes += reader->storedBytes(i);
  }
  content.reader = std::move(reader);
  return ForeignTree::make(std::move(content));
}

} // namespace pointfront
