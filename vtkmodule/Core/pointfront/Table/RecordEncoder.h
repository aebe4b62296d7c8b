#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointBatch.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// Turns points into records of a binary file, little endian and packed: x, y, z as float64, then
/// the parts in the order in which they were added.
/// Exactness  float64 holds every coordinate of a grid exactly as the store gives it. A component
///            is copied; one with a scale or an offset becomes its world value as float64.
/// Threads    one thread.
class RecordEncoder
{
public:
  explicit RecordEncoder(AttributeSchema schema)
    : schema_(std::move(schema))
  {
  }

  /// Adds one component of a column; gives the type it is written with. `widened`: as float64.
  ScalarType add(std::size_t column, std::size_t component, bool widened = false);
  /// Adds a byte that is the same for every point.
  void addByte(std::uint8_t value);

  std::size_t recordBytes() const { return recordBytes_; }
  /// Appends the records of all points of the batch.
  void encode(const PointBatch& batch, std::vector<std::byte>& records) const;

private:
  struct Part
  {
    std::optional<std::size_t> column; ///< nothing: `value`
    std::size_t component = 0;
    bool widened = false;
    std::uint8_t value = 0;
    std::size_t offset = 0; ///< in the record
  };
  void encodePart(const Part& part, const PointBatch& batch, std::byte* records) const;

  AttributeSchema schema_;
  std::vector<Part> parts_;
  std::size_t recordBytes_ = 3 * sizeof(double);
};

} // namespace pointfront
