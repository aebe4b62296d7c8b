#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Statistics/BatchScan.h"
#include "pointfront/Statistics/ValueKey.h"
#include "pointfront/Statistics/ValueSteps.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The number of points that were read, and their bounds.
struct PointCount
{
  std::uint64_t read = 0;
  std::map<std::string, std::uint64_t> rejected; ///< points without a position: reason -> points
  std::uint64_t points = 0; ///< the others
  Bounds bounds; ///< bounds of the positions
};

/// One component of an attribute, or a coordinate.
struct ComponentName
{
  std::string attribute; ///< or "x", "y", "z"
  unsigned component = 0;
  unsigned components = 1;
};

/// The values of one component in one group of points, in world units.
struct ComponentStatistics
{
  std::uint64_t count = 0; ///< finite values: what the rest is about
  std::uint64_t notANumber = 0;
  std::uint64_t infinite = 0;
  std::optional<ExactValue> low; ///< nothing: no value
  std::optional<ExactValue> high;
  ValueMoments moments;
  std::vector<std::uint64_t> histogram; ///< bins of ComponentBins
};

/// Shared by all groups, so that their histograms compare.
struct ComponentBins
{
  std::optional<ExactValue> low; ///< lower end of the first one
  double width = 0.0;
};

struct GroupStatistics
{
  std::uint64_t points = 0;
  Bounds bounds;
  std::vector<ComponentStatistics> components;
};

/// The statistics of a cloud's points.
struct PointStatistics
{
  PointCount counted;
  std::vector<ComponentName> names; ///< names of `bins` and of every group's components
  std::vector<ComponentBins> bins;
  GroupStatistics all;
  std::map<std::uint8_t, GroupStatistics> classes; ///< empty without a classification
  double cellSize = 0.0; ///< side of GroundCells; 0: no ground
  std::uint64_t occupiedCells = 0;

  /// Points per square unit of the ground cells that hold one; nothing without ground.
  std::optional<double> density() const;
};

struct StatisticsOptions
{
  ScanOptions scan;
  std::size_t bins = 32; ///< bins of a histogram, at least 1
};

/// Counts points and takes their bounds: reads all of them once.
/// Result   the same for any number of threads. Errors: of the source.
Result<PointCount> countPoints(const PointSource& source, const ScanOptions& options);

/// Reads all points twice: first for ranges, then for the counts within them.
/// Result   the same for any number of threads: sums are of whole steps (ValueSteps).
/// Memory   options.scan.memoryBytes for batches; beyond it some kilobytes for each class,
///          component and thread, and 2 MiB of ground cells.
/// Errors   of the source.
Result<PointStatistics> gatherStatistics(
  const PointSource& source, const StatisticsOptions& options);

} // namespace pointfront
