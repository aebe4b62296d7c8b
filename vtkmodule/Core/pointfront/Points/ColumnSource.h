#pragma once

#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Points whose attributes lie in memory, one array for each. A class behind it knows where their
/// positions lie and keeps the arrays.
class ColumnSource : public PointSource
{
public:
  const SourceDescription& description() const final { return description_; }
  std::uint64_t chunkCount() const final;
  std::uint64_t chunkPoints(std::uint64_t chunk) const final;
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const final;

protected:
  /// An attribute whose values begin every `stride` bytes; what lies between two of them is left
  /// out. False if there is one of that name.
  bool addColumn(const Attribute& attribute, const void* values, std::size_t stride);

  SourceDescription description_;

private:
  struct Column
  {
    const std::byte* values = nullptr;
    std::size_t stride = 0;
  };
  virtual glm::dvec3 position(std::uint64_t point) const = 0;

  std::vector<Column> columns_; // as in the schema
};

} // namespace pointfront
