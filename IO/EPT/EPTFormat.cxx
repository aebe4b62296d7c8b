#include "EPTFormat.h"

#include "EPTFolder.h"
#include "EPTLasNodes.h"
#include "EPTRecordNodes.h"
#include "EPTSource.h"

#include "pointfront/Disk/ByteOpeners.h"

#include <utility>

namespace pointfront
{

bool EPTFormat::accepts(const std::string& path) const
{
  return fileNameOf(path) == "ept.json";
}

SourceDescription EPTFormat::describe(const EPTNodeDecoder& nodes, const EPTFolder& folder)
{
  const EPTDescription& tree = folder.description;
  SourceDescription description = nodes.description();
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

Result<std::shared_ptr<const EPTNodeDecoder>> EPTFormat::decoderOf(
  std::shared_ptr<const EPTFolder> tree) const
{
  if (tree->nodes.empty())
  {
    return makeError(Error::Kind::BadFormat, tree->path + ": no node of its hierarchy has a point");
  }
  const bool laszip = tree->description.encoding == EPTEncoding::Laszip;
  Result<std::unique_ptr<EPTNodeDecoder>> nodes = laszip
    ? EPTLasNodes::open(std::move(tree), openNode_)
    : EPTRecordNodes::open(std::move(tree), survey_);
  return nodes ? Result<std::shared_ptr<const EPTNodeDecoder>>(std::move(*nodes)) : nodes.error();
}

Result<std::unique_ptr<PointSource>> EPTFormat::open(const std::string& path) const
{
  Result<std::shared_ptr<const EPTFolder>> tree = EPTFolder::open(path);
  if (!tree)
  {
    return tree.error();
  }
  Result<std::shared_ptr<const EPTNodeDecoder>> nodes = decoderOf(*tree);
  if (!nodes)
  {
    return nodes.error();
  }
  SourceDescription description = describe(**nodes, **tree);
  return std::unique_ptr<PointSource>(
    std::make_unique<EPTSource>(std::move(*tree), std::move(*nodes), std::move(description)));
}

} // namespace pointfront
