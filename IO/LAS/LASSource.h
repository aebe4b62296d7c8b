#pragma once

#include "LASFile.h"

#include "pointfront/Points/PointSource.h"

#include <memory>

namespace pointfront
{

/// The points of an uncompressed LAS file, read from a memory map in chunks of 65,536.
/// A file that was cut short is read up to its last whole record, with a warning.
class LASSource final : public PointSource
{
public:
  /// Errors   Truncated if points are claimed and not one is there.
  static Result<std::unique_ptr<PointSource>> open(LASFile file);

  const SourceDescription& description() const override { return file_.description; }
  std::uint64_t chunkCount() const override;
  std::uint64_t chunkPoints(std::uint64_t chunk) const override;
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override;

private:
  void decode(std::uint64_t chunk, PointBatch& batch) const;
  explicit LASSource(LASFile file)
    : file_(std::move(file))
  {
  }

  LASFile file_;
};

} // namespace pointfront
