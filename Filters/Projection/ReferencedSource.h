#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Reference/CoordinateSystems.h"

#include <memory>

namespace pointfront
{

/// A source with another description of where its points are: their system is named in another
/// way, or they are transformed into another system while they are read.
class ReferencedSource final : public PointSource
{
public:
  /// `description` as it is to be; `transform` may be null: coordinates stay as they are.
  ReferencedSource(std::unique_ptr<PointSource> original, SourceDescription description,
    std::shared_ptr<const CoordinateTransform> transform);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  std::unique_ptr<PointSource> original_;
  SourceDescription description_;
  std::shared_ptr<const CoordinateTransform> transform_;
};

} // namespace pointfront
