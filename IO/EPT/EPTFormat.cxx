#include "EPTFormat.h"

#include "EPTFolder.h"
#include "EPTLasNodes.h"
#include "EPTRecords.h"

#include "pointfront/Points/DescribedSource.h"
#include "pointfront/Table/TableSource.h"

#include <filesystem>
#include <utility>

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
  Result<std::shared_ptr<const EPTFolder>> tree = EPTFolder::open(path);
  return tree ? openTree(std::move(*tree)) : tree.error();
}

Result<std::unique_ptr<PointSource>> EPTFormat::openTree(
  std::shared_ptr<const EPTFolder> tree) const
{
  if (tree->nodes.empty())
  {
    return makeError(Error::Kind::BadFormat, tree->path + ": no node of its hierarchy has a point");
  }
  Result<std::unique_ptr<PointSource>> source = tree->description.encoding == EPTEncoding::Laszip
    ? EPTLasNodes::open(tree, openNode_)
    : [&]() -> Result<std::unique_ptr<PointSource>>
  {
    Result<std::unique_ptr<PointTable>> table = EPTRecords::open(tree);
    return table ? TableSource::open(std::move(*table), survey_) : table.error();
  }();
  if (!source)
  {
    return source;
  }
  SourceDescription description = described(**source, tree->description);
  return std::unique_ptr<PointSource>(
    std::make_unique<DescribedSource>(std::move(*source), std::move(description)));
}

} // namespace pointfront
