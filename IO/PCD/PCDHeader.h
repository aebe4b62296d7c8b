#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/ScalarType.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

enum class PCDEncoding
{
  Ascii,
  Binary,
  BinaryCompressed
};

struct PCDField
{
  std::string name;
  ScalarType type = ScalarType::Float32;
  std::size_t count = 1; ///< elements of a point

  std::size_t bytes() const { return sizeOf(type) * count; }
  bool isPadding() const { return name == "_"; }
  /// PCL packs blue, green, red (and alpha) into the bytes of one number.
  bool isPackedColour() const
  {
    return (name == "rgb" || name == "rgba") && sizeOf(type) == 4 && count == 1;
  }
};

/// The header of a PCD file. Nothing is guessed: a file that does not say what its fields are, or
/// that contradicts itself, is refused.
/// Source  "The PCD (Point Cloud Data) file format", PCL documentation; versions .5 to .7.
struct PCDHeader
{
  PCDEncoding encoding = PCDEncoding::Ascii;
  std::vector<PCDField> fields;
  std::uint64_t points = 0;
  std::size_t dataOffset = 0;
  /// Where the sensor was: the first three of VIEWPOINT's seven numbers. Its orientation, the other
  /// four, moves nothing.
  std::optional<glm::dvec3> viewpoint;
  bool viewpointDamaged = false; ///< there is such a line, but without seven numbers
  /// The origin of the coordinates: a comment "# ORIGIN x y z", which PCDWriter writes.
  std::optional<glm::dvec3> origin;
  std::uint64_t lines = 0; ///< number of the header's lines

  std::size_t pointBytes() const; ///< size of one point in a binary file
  /// Errors  BadFormat, Truncated, Unsupported: what, with `path` and the line.
  static Result<PCDHeader> parse(std::string_view text, const std::string& path);
};

} // namespace pointfront
