#pragma once

#include "RasterColumn.h"
#include "RasterImages.h"

#include "pointfront/Points/PointSource.h"

#include <atomic>
#include <memory>
#include <vector>

namespace pointfront
{

/// A source whose points get attributes from images while they are read.
class RasterSource final : public PointSource
{
public:
  /// One attribute of this source.
  struct Input
  {
    RasterColumn column;
    std::size_t target = 0; ///< column of the schema that this source gives
    RasterMosaic::Ways ways;
  };
  RasterSource(std::unique_ptr<PointSource> original, std::shared_ptr<RasterPass::Images> images,
    std::vector<Input> inputs, AttributeSchema schema);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  Result<void> fill(std::size_t input, bool count, PointBatch& batch) const;

  std::unique_ptr<PointSource> original_;
  std::shared_ptr<RasterPass::Images> images_;
  std::vector<Input> inputs_; ///< in the order of the mosaics
  SourceDescription description_;
  mutable std::vector<std::atomic<bool>> counted_; ///< chunks: a chunk read twice counts once
};

} // namespace pointfront
