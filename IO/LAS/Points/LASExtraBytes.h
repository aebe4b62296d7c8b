#pragma once

#include "LASBytes.h"

#include "pointfront/Points/AttributeSchema.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pointfront
{

/// Bytes of one descriptor in the payload of an extra bytes record.
constexpr std::size_t lasExtraBytesDescriptor = 192;

/// The attributes that fill the `byteCount` extra bytes of a point, in their order, as the
/// descriptors in `payloads` (one or more records) name them.
/// Undocumented bytes (data type 0, or behind the last descriptor) become uint8 attributes of at
/// most 16 components, "extra" unless they have a name. Arrays of two or three become components;
/// when those differ in scale or offset, attributes of their own, "name[0]" and so on.
/// Source   ASPRS LAS 1.4 R15, section 2.4 (extra bytes), with the types 11 to 30 of R13.
std::vector<Attribute> parseExtraBytes(
  const std::vector<ByteSpan>& payloads, std::size_t byteCount, std::vector<std::string>& warnings);

/// The payload that describes `attributes` in that order. A descriptor of `originals` that says
/// the same of an attribute is taken over whole, with its no-data value and range.
std::vector<std::byte> composeExtraBytes(
  const std::vector<Attribute>& attributes, const std::vector<ByteSpan>& originals);

} // namespace pointfront
