#pragma once

#include "pointfront/Points/PointSink.h"

#include <memory>
#include <string>

namespace pointfront
{

/// Writes points as binary little endian PLY: one element "vertex".
/// Properties  x, y, z as double; rgb as red, green, blue; normal as nx, ny, nz; every other
///             attribute by its name, the components of an array as name[0], name[1] ... Types are
///             kept but for those PLY lacks: 64-bit integers and scaled ones become double.
/// CRS         PLY has no place for it: it is lost.
/// Errors      as in PointSink.
/// Threads     one thread.
class PLYWriter final : public PointSink
{
public:
  explicit PLYWriter(std::string path);
  ~PLYWriter() override;
  PLYWriter(const PLYWriter&) = delete;
  PLYWriter& operator=(const PLYWriter&) = delete;

  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  Result<void> finish() override;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
