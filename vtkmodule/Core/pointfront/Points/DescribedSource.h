#pragma once

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <utility>

namespace pointfront
{

/// The points of another source under a description of its own: who opened it knows more of it than
/// it does.
/// Threads  as the original.
class DescribedSource final : public PointSource
{
public:
  /// Counts and schema of the description are those of the original.
  DescribedSource(std::shared_ptr<const PointSource> original, SourceDescription description)
    : original_(std::move(original))
    , description_(std::move(description))
  {
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_->read(chunk, batch);
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_->readSteps(chunk, batch);
  }

private:
  std::shared_ptr<const PointSource> original_;
  SourceDescription description_;
};

} // namespace pointfront
