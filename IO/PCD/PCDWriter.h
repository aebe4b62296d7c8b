#pragma once

#include "pointfront/Table/RecordWriter.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Writes points as binary PCD 0.7.
/// Coordinates  float32, as PCL's types of points have them. Where that would round what the grid
///              tells apart they are relative to an origin of whole units near the middle, which a
///              comment of the header states ("# ORIGIN x y z": read here, skipped by others). Or
///              float64, which PCL 1.13 reads into no type of points.
/// Fields    rgb of 8 bits packed into one float32, as PCL has it, of 16 bits as red, green, blue;
///           normal as normal_x, normal_y, normal_z of float32; intensity as float32; every other
///           attribute by its name, arrays with their COUNT. Types are kept; scaled integers become
///           float64.
class PCDWriter final : public RecordWriter
{
public:
  enum class Coordinates
  {
    Float32,
    Float64
  };
  explicit PCDWriter(std::string path, Coordinates coordinates = Coordinates::Float32);
  std::vector<std::string> findings() const override;

private:
  CoordinateCoding coordinates(const SinkDescription& description) override;
  RecordFile::Header describe(
    const AttributeSchema& schema, const FieldNames& names, RecordEncoder& encoder) const override;

  Coordinates coordinates_;
  std::vector<std::string> findings_;
};

} // namespace pointfront
