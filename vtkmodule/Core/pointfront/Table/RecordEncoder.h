#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointBatch.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// How coordinates are written.
struct CoordinateCoding
{
  ScalarType type = ScalarType::Float64; ///< or Float32
  glm::dvec3 origin{ 0.0 }; ///< is taken from them
};

/// Turns points into records of a binary file, little endian and packed: x, y, z, then the parts in
/// the order in which they were added.
/// Exactness  float64 holds every coordinate of a grid exactly as the store gives it. A component
///            is copied; one with a scale or an offset becomes its world value as float64. Integers
///            of 64 bits that float64 does not hold are rounded and counted.
/// Threads    one thread.
class RecordEncoder
{
public:
  explicit RecordEncoder(AttributeSchema schema, CoordinateCoding coordinates = {})
    : schema_(std::move(schema))
    , coordinates_(coordinates)
    , recordBytes_(3 * sizeOf(coordinates.type))
    , rounded_(schema_.size(), 0)
  {
  }

  const CoordinateCoding& coordinates() const { return coordinates_; }
  /// Adds one component of a column; gives the type it is written with. `as`: Float32 or Float64,
  /// whatever the column's is.
  ScalarType add(
    std::size_t column, std::size_t component, std::optional<ScalarType> as = std::nullopt);
  /// Adds a byte that is the same for every point.
  void addByte(std::uint8_t value);

  std::size_t recordBytes() const { return recordBytes_; }
  /// Appends the records of all points of the batch.
  void encode(const PointBatch& batch, std::vector<std::byte>& records);
  /// Attributes of which encode() had to round integers: full sentences.
  std::vector<std::string> findings() const;

private:
  struct Part
  {
    std::optional<std::size_t> column; ///< nothing: `value`
    std::size_t component = 0;
    std::optional<ScalarType> as; ///< nothing: copied
    std::uint8_t value = 0;
    std::size_t offset = 0; ///< in the record
  };
  void encodePart(const Part& part, const PointBatch& batch, std::byte* records);

  AttributeSchema schema_;
  CoordinateCoding coordinates_;
  std::vector<Part> parts_;
  std::size_t recordBytes_;
  std::vector<std::uint64_t> rounded_; ///< values of each column
};

} // namespace pointfront
