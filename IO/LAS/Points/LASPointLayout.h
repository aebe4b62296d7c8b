#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

constexpr int lasHighestPointFormat = 10;

/// Bytes of a record of that format (0 to 10) without extra bytes.
std::size_t lasMinimumPointBytes(int pointFormat);

/// Where the optional parts of a point format begin; 0: it has none.
struct LASFormatParts
{
  std::uint16_t bytes; ///< size of a record without extra bytes, which follow
  std::uint16_t gpsTime;
  std::uint16_t rgb;
  std::uint16_t nir;
  std::uint16_t wave;
};
/// The parts of a format from 0 to 10.
const LASFormatParts& lasFormatParts(int pointFormat);

/// How one column lies in a point record.
struct LASField
{
  enum class Kind : std::uint8_t
  {
    Copy, ///< the bytes of the column as they are
    Bits, ///< (byte >> shift) & mask
    Angle8, ///< int8, degrees
    Angle16 ///< int16, steps of 0.006 degrees
  };
  Kind kind = Kind::Copy;
  std::uint8_t shift = 0;
  std::uint8_t mask = 0;
  std::uint16_t offset = 0; ///< byte in the record
};

/// Where the attributes of a point lie in its LAS record: the reader's and the writer's one truth.
/// Shapes   fields[c] is where column c of `schema` lies. Position: int32 x 3 at byte 0.
/// Names    as in AttributeSchema.h; wave packets (formats 4, 5, 9, 10) are wave_descriptor u8,
///          wave_offset u64, wave_size u32, wave_return_location f32 (picoseconds), wave_vector
///          f32x3; extra bytes follow.
/// Source   ASPRS LAS 1.4 R15, section 2.6.
struct LASPointLayout
{
  int pointFormat = 0;
  std::size_t pointBytes = 0; ///< size of one record, extra bytes and all
  AttributeSchema schema;
  std::vector<LASField> fields;
};

/// The layout of the format's own fields, followed by `extra` in that order.
/// A name that is taken gets "_2", "_3" ... appended.
LASPointLayout makeLASPointLayout(int pointFormat, const std::vector<Attribute>& extra);

} // namespace pointfront
