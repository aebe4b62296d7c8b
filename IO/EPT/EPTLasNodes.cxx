#include "EPTLasNodes.h"

#include <utility>

namespace pointfront
{

Result<std::unique_ptr<EPTNodeDecoder>> EPTLasNodes::open(
  std::shared_ptr<const EPTFolder> tree, EPTFormat::Opener openNode)
{
  std::unique_ptr<EPTLasNodes> source(new EPTLasNodes);
  source->tree_ = std::move(tree);
  source->openNode_ = std::move(openNode);
  const Result<RawBytes> bytes = source->tree_->readNode(source->tree_->nodes.front());
  if (!bytes)
  {
    return bytes.error();
  }
  const Result<std::unique_ptr<PointSource>> first =
    source->openNode_(source->tree_->fileOf(source->tree_->nodes.front()), *bytes);
  if (!first)
  {
    return first.error();
  }
  SourceDescription& description = source->description_;
  description = (*first)->description();
  description.path = source->tree_->path;
  description.format = "EPT of " + description.format;
  description.declaredBounds = Bounds();
  description.warnings.clear();
  // Not all nodes are known where pages of the hierarchy were not read.
  description.pointCount = source->tree_->pages.empty() ? 0 : source->tree_->description.points;
  for (const EPTNode& node : source->tree_->nodes)
  {
    description.pointCount += source->tree_->pages.empty() ? node.points : 0;
  }
  return std::unique_ptr<EPTNodeDecoder>(std::move(source));
}

Result<void> EPTLasNodes::decode(
  const EPTNode& node, const RawBytes& bytes, PointBatch& batch) const
{
  const std::string path = tree_->fileOf(node);
  const Result<std::unique_ptr<PointSource>> file = openNode_(path, bytes);
  if (!file)
  {
    return file.error();
  }
  const SourceDescription& found = (*file)->description();
  if (found.pointCount != node.points || !(found.schema == description_.schema) ||
    !(found.grid == description_.grid))
  {
    return makeError(Error::Kind::BadFormat,
      path + ": holds " + std::to_string(found.pointCount) + " points where the hierarchy has " +
        std::to_string(node.points) + ", or other attributes or scales than the other nodes");
  }
  batch.resize(0, description_.schema);
  PointBatch part;
  for (std::uint64_t c = 0; c < (*file)->chunkCount(); ++c)
  {
    if (Result<void> done = (*file)->read(c, part); !done)
    {
      return done;
    }
    batch.append(part);
  }
  if (batch.positions.size() != node.points)
  {
    return makeError(Error::Kind::Truncated,
      path + ": gives " + std::to_string(batch.positions.size()) + " of its " +
        std::to_string(node.points) + " points; get a whole copy");
  }
  return {};
}

} // namespace pointfront
