#pragma once

#include "pointfront/Points/PointSource.h"

#include <utility>

namespace pointfront
{

/// A source that has the attributes and systems of another one, and no points.
/// Threads  immutable.
class EmptySource final : public PointSource
{
public:
  explicit EmptySource(SourceDescription description)
    : description_(std::move(description))
  {
    description_.pointCount = 0;
    description_.headerPointCount.reset();
    description_.warnings.clear();
    description_.scanners.clear();
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return 0; }
  std::uint64_t chunkPoints(std::uint64_t) const override { return 0; }
  Result<void> read(std::uint64_t, PointBatch&) const override { return {}; }

private:
  SourceDescription description_;
};

} // namespace pointfront
