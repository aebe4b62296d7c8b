#pragma once

#include "EPTFolder.h"
#include "EPTNodeDecoder.h"

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <utility>

namespace pointfront
{

/// The points of an Entwine tree: each node is a chunk, whose file is read when the chunk is.
/// Threads  read() from any thread.
class EPTSource final : public PointSource
{
public:
  EPTSource(std::shared_ptr<const EPTFolder> tree, std::shared_ptr<const EPTNodeDecoder> decoder,
    SourceDescription description)
    : tree_(std::move(tree))
    , decoder_(std::move(decoder))
    , description_(std::move(description))
  {
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return tree_->nodes.size(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return tree_->nodes[static_cast<std::size_t>(chunk)].points;
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    const EPTNode& node = tree_->nodes[static_cast<std::size_t>(chunk)];
    const Result<RawBytes> file = tree_->readNode(node);
    return file ? decoder_->decode(node, *file, batch) : Result<void>(file.error());
  }

private:
  std::shared_ptr<const EPTFolder> tree_;
  std::shared_ptr<const EPTNodeDecoder> decoder_;
  SourceDescription description_;
};

} // namespace pointfront
