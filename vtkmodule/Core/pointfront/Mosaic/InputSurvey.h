#pragma once

#include "pointfront/Mosaic/TileGrid.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Threads/WorkCrew.h"

#include <bitset>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts about a chunk of an input that has been read.
struct SurveyedChunk
{
  Bounds bounds; ///< bounds of the points that have a place; empty without one
  std::uint64_t hash = 0; ///< hash of all values
};

/// The facts about an input that must be known before tiles can be built.
struct InputSurvey
{
  std::vector<SurveyedChunk> chunks;
  std::map<TileIndex, std::uint64_t> tiles; ///< points in each
  std::uint64_t read = 0;
  std::map<std::string, std::uint64_t> rejected; ///< points without a place: reason -> count
  std::bitset<256> classes; ///< classes of the points that have a place
  std::uint16_t largestColour = 0; ///< largest value of a 16-bit "rgb"; 0 without one

  Bounds bounds() const;
};

/// A hash of all values of the points: that of SurveyedChunk.
std::uint64_t hashOfPoints(const PointBatch& batch);

/// Reads all points of an input once, by all threads of the crew, which is told how far it is.
/// Errors  those of the source; BadFormat: more points than announced; Cancelled.
/// Order   the result does not depend on threads.
Result<InputSurvey> surveyInput(const PointSource& source, const TileGrid& grid, WorkCrew& crew);

} // namespace pointfront
