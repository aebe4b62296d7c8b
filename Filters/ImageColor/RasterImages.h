#pragma once

#include "ImageValuesPass.h"
#include "RasterMosaic.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// How the points of one attribute fared; written by all threads that read.
struct RasterTally
{
  std::atomic<std::uint64_t> seen{ 0 };
  std::atomic<std::uint64_t> without{ 0 }; ///< no image has data for them
  std::atomic<std::uint64_t> notHeld{ 0 }; ///< the value does not fit the column's type
};

/// State that all sources share while they are read: tiles, mosaics, counts. Lives as long as the
/// pass or any of its sources.
struct ImageValuesPass::Images
{
  explicit Images(std::uint64_t bytes)
    : tileBytes(bytes)
    , tiles(bytes)
  {
  }
  std::uint64_t tileBytes; ///< most memory for tiles
  RasterTiles tiles;
  std::vector<RasterMosaic> mosaics; ///< one for each input
  std::vector<std::unique_ptr<RasterTally>> tallies;
  std::uint64_t points = 0; ///< points of all sources: counts are told when all have been read
  std::vector<std::string> warnings; ///< known before the first point
};

} // namespace pointfront
