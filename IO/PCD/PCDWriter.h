#pragma once

#include "pointfront/Points/PointSink.h"

#include <memory>
#include <string>

namespace pointfront
{

/// Writes points as binary PCD 0.7.
/// Fields    x, y, z as float64; rgb of 8 bits packed into one number, as PCL has it, of 16 bits as
///           red, green, blue; normal as normal_x, normal_y, normal_z; every other attribute by its
///           name, arrays with their COUNT. Types are kept; scaled integers become float64.
/// CRS       PCD has no place for it: it is lost.
/// Errors    as in PointSink.
/// Threads   one thread.
class PCDWriter final : public PointSink
{
public:
  explicit PCDWriter(std::string path);
  ~PCDWriter() override;
  PCDWriter(const PCDWriter&) = delete;
  PCDWriter& operator=(const PCDWriter&) = delete;

  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  Result<void> finish() override;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
