#pragma once

#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <vector>

namespace pointfront
{

/// Points whose places and attributes lie in plain arrays of the caller, who keeps them.
class ArraySource final : public PointSource
{
public:
  /// `places`  three doubles for each of `points` points.
  ArraySource(const double* places, std::uint64_t points);

  /// An attribute, `values` as many as there are points. False if there is one of that name.
  bool add(const Attribute& attribute, const void* values);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override;
  std::uint64_t chunkPoints(std::uint64_t chunk) const override;
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  SourceDescription description_;
  const double* places_;
  std::vector<const std::byte*> columns_; ///< as in the schema
};

} // namespace pointfront
