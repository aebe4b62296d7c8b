#pragma once

#include "EPTFolder.h"
#include "EPTFormat.h"

#include "pointfront/Points/PointSource.h"

#include <memory>

namespace pointfront
{

/// The LAZ files of an Entwine tree as one source: each node is a chunk. A file is opened when its
/// chunk is read.
/// Errors  open: of the first file. read: of the node's file; BadFormat where it is another than
///         the hierarchy says, or has other attributes or another grid than the first.
class EPTLasNodes final : public PointSource
{
public:
  static Result<std::unique_ptr<PointSource>> open(
    std::shared_ptr<const EPTFolder> tree, EPTFormat::Opener openNode);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return tree_->nodes.size(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return tree_->nodes[static_cast<std::size_t>(chunk)].points;
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  EPTLasNodes() = default;

  std::shared_ptr<const EPTFolder> tree_;
  EPTFormat::Opener openNode_;
  SourceDescription description_;
};

} // namespace pointfront
