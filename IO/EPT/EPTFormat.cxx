#include "EPTFormat.h"

#include "EPTLasNodes.h"
#include "EPTRecords.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Points/DescribedSource.h"
#include "pointfront/Table/TableSource.h"

#include <filesystem>

namespace pointfront
{
namespace
{
/// Of a source, with what the tree says of it.
SourceDescription described(const PointSource& source, const EPTDescription& tree)
{
  SourceDescription description = source.description();
  description.declaredBounds = tree.bounds;
  description.boundsLookedUp = false;
  description.headerPointCount = tree.points;
  description.crsWkt = description.crsWkt.empty() ? tree.wkt : description.crsWkt;
  if (tree.points != description.pointCount)
  {
    description.warnings.push_back("Its description promises " + std::to_string(tree.points) +
      " points, the nodes of its hierarchy " + std::to_string(description.pointCount) +
      ": the second was used.");
  }
  return description;
}
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
  SourceDescription description = described(**source, *tree);
  return std::unique_ptr<PointSource>(
    std::make_unique<DescribedSource>(std::move(*source), std::move(description)));
}

} // namespace pointfront
