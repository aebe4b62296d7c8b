#pragma once

#include "pointfront/Table/RecordWriter.h"

#include <string>

namespace pointfront
{

/// Writes points as binary PCD 0.7.
/// Fields    x, y, z as float64; rgb of 8 bits packed into one number, as PCL has it, of 16 bits as
///           red, green, blue; normal as normal_x, normal_y, normal_z; every other attribute by its
///           name, arrays with their COUNT. Types are kept; scaled integers become float64.
class PCDWriter final : public RecordWriter
{
public:
  explicit PCDWriter(std::string path);

private:
  RecordFile::Header describe(
    const AttributeSchema& schema, RecordEncoder& encoder) const override;
};

} // namespace pointfront
