#pragma once

#include "pointfront/Ingest/BlockCells.h"
#include "pointfront/Ingest/CellTable.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Records/RecordPool.h"
#include "pointfront/Records/TreeSpace.h"
#include "pointfront/Threads/WorkCrew.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The inputs of an ingest, and the place of its records.
struct IngestSite
{
  const std::vector<std::unique_ptr<PointSource>>& sources;
  const CommonSchema& common;
  const RecordColumns& columns;
  const TreeSpace& space;
  RecordPool& pool; ///< pool of records with those columns
  std::uint64_t blockPoints = 0;
  unsigned leastCellsLog2 = 0; ///< cells along the extent, at least; if bounds are what they say
  WorkCrew& crew;
};

/// The facts about the points that are known once all are read.
struct IngestedPoints
{
  std::uint64_t read = 0;
  std::uint64_t kept = 0; ///< records 0 to kept - 1 of the pool
  std::map<std::string, std::uint64_t> rejected;
  GridPosition low{ INT64_MAX }; ///< grid steps
  GridPosition high{ INT64_MIN };
  ClassCounts counts{ 0 };
  std::vector<PoolBlock> blocks; ///< blocks of the pool, in input order
  std::vector<std::uint64_t> sourceEnd; ///< end of each source's records in the pool
  std::vector<std::uint16_t> largestColour; ///< largest value of each source's "rgb", 0 without one
  unsigned hintedShift = 0; ///< shift of the cells before any were joined
  double readSeconds = 0.0; ///< CPU, over all threads
  double quantiseSeconds = 0.0;
  /// A guess about a column that was left out of the records was wrong. Nothing else here is
  /// complete: the points must be read again with the wrong columns carried.
  bool guessedWrong = false;
  std::vector<bool> wrong; ///< for each common column
};

/// Reads every chunk of every source once: decodes, rejects what is no position, rounds to the
/// grid, packs records and counts cells. Records come into the pool block by block in input order,
/// inside a block by cells (BlockCells.h). Declared bounds are a hint for the first size of the
/// cells only; nothing else trusts them.
/// Errors  the first of any source's read(), or of the pool.
/// `classOffset`: the byte of a record by which cells are counted apart; nothing: all as class 0.
Result<IngestedPoints> ingestPoints(
  const IngestSite& site, std::optional<std::size_t> classOffset = std::nullopt);

} // namespace pointfront
