#pragma once

#include "RasterColumn.h"
#include "RasterImages.h"

#include "pointfront/Points/PointSource.h"

#include <atomic>
#include <memory>
#include <vector>

namespace pointfront
{

class SortedRasterValues;

/// One attribute of a source that images give.
struct RasterSourceInput
{
  RasterColumn column;
  std::size_t target = 0; ///< column of the schema that the source gives
  RasterMosaic::Ways ways;
};

/// A source whose points get attributes from images while they are read, or before.
class RasterSource final : public PointSource
{
public:
  using Input = RasterSourceInput;
  RasterSource(std::unique_ptr<PointSource> original,
    std::shared_ptr<ImageValuesPass::Images> images, std::vector<Input> inputs,
    AttributeSchema schema);
  /// Takes values that were looked up before for all sources, of which this is `number`.
  void use(std::shared_ptr<const SortedRasterValues> sorted, std::size_t number);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  Result<void> fill(std::size_t input, bool count, PointBatch& batch) const;
  void fill(
    std::size_t input, bool count, const std::vector<std::byte>& values, PointBatch& batch) const;

  std::unique_ptr<PointSource> original_;
  std::shared_ptr<ImageValuesPass::Images> images_;
  std::shared_ptr<const SortedRasterValues> sorted_; ///< none: pixels are looked up in read()
  std::size_t number_ = 0;
  std::vector<Input> inputs_; ///< in the order of the mosaics
  SourceDescription description_;
  mutable std::vector<std::atomic<bool>> counted_; ///< chunks: a chunk read twice counts once
};

} // namespace pointfront
