#include "EPTLasNodes.h"

#include <utility>

namespace pointfront
{

std::string EPTLasNodes::fileOf(const EPTNode& node) const
{
  return folder_ + "/ept-data/" + node.key + ".laz";
}

Result<std::unique_ptr<PointSource>> EPTLasNodes::open(const std::string& path,
  const std::string& folder, std::vector<EPTNode> nodes, EPTFormat::Opener openNode)
{
  std::unique_ptr<EPTLasNodes> source(new EPTLasNodes);
  source->folder_ = folder;
  source->nodes_ = std::move(nodes);
  source->openNode_ = std::move(openNode);
  const Result<std::unique_ptr<PointSource>> first =
    source->openNode_(source->fileOf(source->nodes_.front()));
  if (!first)
  {
    return first.error();
  }
  SourceDescription& description = source->description_;
  description = (*first)->description();
  description.path = path;
  description.format = "EPT of " + description.format;
  description.declaredBounds = Bounds();
  description.warnings.clear();
  description.pointCount = 0;
  for (const EPTNode& node : source->nodes_)
  {
    description.pointCount += node.points;
  }
  return std::unique_ptr<PointSource>(std::move(source));
}

Result<void> EPTLasNodes::read(std::uint64_t chunk, PointBatch& batch) const
{
  const EPTNode& node = nodes_[static_cast<std::size_t>(chunk)];
  const std::string path = fileOf(node);
  const Result<std::unique_ptr<PointSource>> file = openNode_(path);
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
    batch.positions.insert(batch.positions.end(), part.positions.begin(), part.positions.end());
    for (std::size_t column = 0; column < part.columns.size(); ++column)
    {
      batch.columns[column].insert(
        batch.columns[column].end(), part.columns[column].begin(), part.columns[column].end());
    }
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
