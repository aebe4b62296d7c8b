#pragma once

#include "pointfront/Points/ScalarType.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// One attribute that every point has besides its position.
/// Shapes   `components` scalars of `type` a point, interleaved, native byte order in memory.
/// Units    world value = stored * scale + offset, for each component (LAS extra bytes have them;
///          1 and 0 for all others).
struct Attribute
{
  std::string name;
  ScalarType type = ScalarType::UInt8;
  std::uint8_t components = 1; ///< 1 to 16
  double scale = 1.0;
  double offset = 0.0;
  std::string description = {}; ///< from the source, may be empty

  std::size_t bytes() const { return sizeOf(type) * components; } ///< size of one point
  friend bool operator==(const Attribute& a, const Attribute& b)
  {
    return a.name == b.name && a.type == b.type && a.components == b.components &&
      a.scale == b.scale && a.offset == b.offset;
  }
};

/// The attributes of a cloud, in the order of their columns. Names are unique.
/// Well-known names (all lower case; extra bytes keep the name their file gives them):
///   intensity u16, return_number u8, return_count u8, classification u8, classification_flags u8,
///   scan_direction u8, edge_of_flight_line u8, scanner_channel u8, scan_angle f32 (degrees),
///   user_data u8, point_source_id u16, gps_time f64, rgb u8x3 or u16x3, nir u16, normal f32x3 or
///   i16x3 with a scale (NormalAttribute.h).
/// classification_flags holds the bits synthetic 1, key point 2, withheld 4, overlap 8.
class AttributeSchema
{
public:
  /// Appends; false (and nothing happens) when the name is taken.
  bool add(Attribute attribute);
  std::size_t size() const { return attributes_.size(); }
  bool empty() const { return attributes_.empty(); }
  const Attribute& operator[](std::size_t column) const { return attributes_[column]; }
  /// Column of that name, exact first, then without regard to case.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Bytes of one point over all columns, without its position.
  std::size_t pointBytes() const;

  std::vector<Attribute>::const_iterator begin() const { return attributes_.begin(); }
  std::vector<Attribute>::const_iterator end() const { return attributes_.end(); }
  friend bool operator==(const AttributeSchema& a, const AttributeSchema& b)
  {
    return a.attributes_ == b.attributes_;
  }

private:
  std::vector<Attribute> attributes_;
};

} // namespace pointfront
