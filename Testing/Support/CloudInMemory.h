#pragma once

#include "pointfront/Points/PointSource.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace pointfront::test
{

/// A source of given points in chunks of `pointsPerChunk`, without attributes.
class CloudInMemory final : public PointSource
{
public:
  CloudInMemory(std::string path, std::vector<glm::dvec3> points, std::string wkt = "",
    std::uint64_t pointsPerChunk = 1000)
    : points_(std::move(points))
    , pointsPerChunk_(pointsPerChunk)
  {
    description_.path = std::move(path);
    description_.pointCount = points_.size();
    description_.crsWkt = std::move(wkt);
    for (const glm::dvec3& p : points_)
    {
      description_.declaredBounds.add(p);
    }
  }

  SourceDescription& describe() { return description_; }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override
  {
    return (points_.size() + pointsPerChunk_ - 1) / pointsPerChunk_;
  }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return std::min<std::uint64_t>(pointsPerChunk_, points_.size() - chunk * pointsPerChunk_);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    batch.resize(chunkPoints(chunk), description_.schema);
    std::copy_n(points_.begin() + static_cast<std::ptrdiff_t>(chunk * pointsPerChunk_),
      batch.size(), batch.positions.begin());
    return {};
  }

private:
  SourceDescription description_;
  std::vector<glm::dvec3> points_;
  std::uint64_t pointsPerChunk_;
};

} // namespace pointfront::test
