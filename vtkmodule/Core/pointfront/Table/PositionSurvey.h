#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <array>
#include <optional>

namespace pointfront
{

/// Facts of the coordinates of one axis.
struct AxisFacts
{
  double low = 0.0;
  double high = 0.0;
  /// Every coordinate is a multiple of 10^-decimals; nothing if there is no such step.
  std::optional<int> decimals = 0;
};

/// Where positions lie.
struct PositionExtent
{
  Bounds bounds;
  /// A decimal grid that all lie on, if a store can hold it: fewer steps than 2^31 in the extent,
  /// and no more digits than double precision has.
  std::optional<QuantisationGrid> grid;

  /// As what was looked up; a grid that the source states itself stays.
  void describe(SourceDescription& description) const;
};

/// `origin` is to be added to the coordinates; one of whole units changes nothing about their
/// decimals. One step for all axes where they have it; heights in metres over degrees have not.
PositionExtent extentOf(const std::array<AxisFacts, 3>& axes, const glm::dvec3& origin);

/// Reads all positions of a source of float32 or float64, from several threads. Those that are no
/// positions (NaN, beyond farthestCoordinate) say nothing. Errors  of reading; Cancelled.
Result<PositionExtent> surveyPositions(const PointSource& source, const SurveyOptions& options);

} // namespace pointfront
