#pragma once

#include "pointfront/Table/RecordWriter.h"

#include <string>

namespace pointfront
{

/// Writes points as binary little endian PLY: one element "vertex".
/// Properties  x, y, z as double; rgb as red, green, blue; normal as nx, ny, nz; every other
///             attribute by its name, the components of an array as name[0], name[1] ... Types are
///             kept but for those PLY lacks: 64-bit integers and scaled ones become double;
///             findings() counts integers that it rounds and tells of names that change.
class PLYWriter final : public RecordWriter
{
public:
  explicit PLYWriter(std::string path);

private:
  RecordFile::Header describe(
    const AttributeSchema& schema, const FieldNames& names, RecordEncoder& encoder) const override;
};

} // namespace pointfront
