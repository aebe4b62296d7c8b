#include "EPTFormat.h"

#include "EPTLasNodes.h"
#include "EPTRecords.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Table/TableSource.h"

#include <filesystem>

namespace pointfront
{
namespace
{
/// A source with what the tree says of it.
class DescribedSource final : public PointSource
{
public:
  DescribedSource(std::unique_ptr<PointSource> original, const EPTDescription& tree)
    : original_(std::move(original))
    , description_(original_->description())
  {
    description_.declaredBounds = tree.bounds;
    description_.boundsLookedUp = false;
    description_.headerPointCount = tree.points;
    description_.crsWkt = description_.crsWkt.empty() ? tree.wkt : description_.crsWkt;
    if (tree.points != description_.pointCount)
    {
      description_.warnings.push_back("Its description promises " + std::to_string(tree.points) +
        " points, the nodes of its hierarchy " + std::to_string(description_.pointCount) +
        ": the second was used.");
    }
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_->read(chunk, batch);
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_->readSteps(chunk, batch);
  }

private:
  std::unique_ptr<PointSource> original_;
  SourceDescription description_;
};
} // namespace

bool EPTFormat::accepts(const std::string& path) const
{
  return std::filesystem::path(path).filename() == "ept.json";
}

Result<std::unique_ptr<PointSource>> EPTFormat::open(const std::string& path) const
{
  const Result<MemoryMap> map = MemoryMap::open(path);
  if (!map)
  {
    return map.error();
  }
  const std::string_view text(reinterpret_cast<const char*>(map->data()), map->size());
  Result<EPTDescription> tree = EPTDescription::parse(text, path);
  if (!tree)
  {
    return tree.error();
  }
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  Result<std::vector<EPTNode>> nodes = readEPTHierarchy(folder);
  if (!nodes)
  {
    return nodes.error();
  }
  if (nodes->empty())
  {
    return makeError(Error::Kind::BadFormat, path + ": no node of its hierarchy has a point");
  }
  Result<std::unique_ptr<PointSource>> source = tree->encoding == EPTEncoding::Laszip
    ? EPTLasNodes::open(path, folder, std::move(*nodes), openNode_)
    : [&]() -> Result<std::unique_ptr<PointSource>>
  {
    Result<std::unique_ptr<PointTable>> table =
      EPTRecords::open(path, folder, *tree, std::move(*nodes));
    return table ? TableSource::open(std::move(*table), survey_) : table.error();
  }();
  if (!source)
  {
    return source;
  }
  return std::unique_ptr<PointSource>(std::make_unique<DescribedSource>(std::move(*source), *tree));
}

} // namespace pointfront
