#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/ScalarType.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

enum class PLYEncoding
{
  Ascii,
  LittleEndian,
  BigEndian
};

struct PLYProperty
{
  std::string name;
  ScalarType type = ScalarType::Float32; ///< type of the value, or of each value of a list
  std::optional<ScalarType> listCount; ///< integer; the property is a list
};

struct PLYElement
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<PLYProperty> properties;

  bool hasList() const;
  /// Bytes of one row in a binary file; of its fixed part if there are lists.
  std::size_t rowBytes() const;
};

/// The header of a PLY file: what its body holds, in which order.
/// Source  Greg Turk, "The PLY Polygon File Format", 1994, and the type names that came after it
///         (int8 ... float64).
struct PLYHeader
{
  PLYEncoding encoding = PLYEncoding::Ascii;
  std::vector<PLYElement> elements; ///< in the order of the body
  std::size_t bodyOffset = 0;
  std::uint64_t lines = 0; ///< number of the header's lines

  /// Errors  BadFormat, Truncated, Unsupported: what, with `path` and the line.
  static Result<PLYHeader> parse(std::string_view text, const std::string& path);
};

} // namespace pointfront
