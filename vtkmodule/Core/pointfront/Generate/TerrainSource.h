#pragma once

#include "pointfront/Generate/TerrainModel.h"
#include "pointfront/Points/PointSource.h"

namespace pointfront
{

/// A synthetic airborne survey of any size as a PointSource: what `pointfront generate` writes and
/// what tests and benchmarks read without a file.
/// Points   about 10 a square metre, in flight strips of 80 m, tile by tile along the strip, scan
///          line by scan line inside a tile: the order of a real survey.
/// Grid     1 mm; UTM-like eastings and northings (no CRS is claimed).
/// Schema   intensity, return_number, return_count, classification, scanner_channel, scan_angle,
///          point_source_id (the strip), gps_time, rgb (16 bit).
/// Threads  read() is a function of (seed, chunk) and safe from any thread.
class TerrainSource final : public PointSource
{
public:
  TerrainSource(std::uint64_t points, std::uint64_t seed);
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override;
  std::uint64_t chunkPoints(std::uint64_t chunk) const override;
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  std::uint64_t seed_;
  TerrainModel model_;
  std::uint64_t tilesAlongStrip_ = 1;
  SourceDescription description_;
};

} // namespace pointfront
