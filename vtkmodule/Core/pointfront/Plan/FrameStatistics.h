#pragma once

#include "pointfront/Front/FrontDelta.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// The results of one frame of one cloud: for properties, tables and log lines.
struct FrameStatistics
{
  std::uint64_t points = 0; ///< drawn
  std::vector<std::uint64_t> layerPoints; ///< FramePlan::layerPoints()
  std::uint64_t nodes = 0; ///< that they are of
  /// Drawn beside the front's, as they were visible in the frame before (SMOOTH-7).
  std::uint64_t keptPoints = 0;
  std::uint32_t frontLength = 0;
  std::uint32_t moves = 0;
  std::uint64_t requests = 0;
  double errorPx = 0.0; ///< as FrontDelta::errorPx
  double thresholdPx = 0.0; ///< that the front worked with
  double frontMilliseconds = 0.0;
  std::int64_t gpuBytes = 0;
  std::int64_t windowGpuBytes = 0; ///< memory of all clouds of the window
  std::string technique; ///< as MeasuredTechnique says it; empty: not measured
  /// Nothing is missing: no further frame of the same view differs.
  bool complete = false;
  bool limitedByPoints = false; ///< the budget of points, or a frame's time
  bool limitedByGpuMemory = false;
  bool limitedByMemory = false; ///< by the host's memory
  std::vector<std::uint16_t> layersLeftOut; ///< FrontDelta::layersLeftOut, of any drawing
  std::uint32_t failedNodes = 0; ///< that could not be read

  /// Takes the results of an update of the front. Points and nodes are those that the front names;
  /// the back end sets `complete` and GPU memory.
  void take(const FrontDelta& delta)
  {
    points = delta.pointsDrawn;
    nodes = delta.draw.size();
    frontLength = delta.frontLength;
    moves = delta.moves;
    requests = delta.requests.size();
    errorPx = delta.errorPx;
    thresholdPx = delta.thresholdPx;
    limitedByPoints = delta.limitedByBudget;
    limitedByGpuMemory = delta.limitedByGpu;
    limitedByMemory = delta.limitedByMemory;
    layersLeftOut = delta.layersLeftOut;
    failedNodes = delta.failedNodes;
  }

  /// Adds those of another drawing of the cloud in the same frame: sums, and the worse of both.
  /// GPU memory is the mapper's, and stays.
  void add(const FrameStatistics& other)
  {
    points += other.points;
    layerPoints.resize(std::max(layerPoints.size(), other.layerPoints.size()));
    for (std::size_t i = 0; i < other.layerPoints.size(); ++i)
    {
      layerPoints[i] += other.layerPoints[i];
    }
    nodes += other.nodes;
    keptPoints += other.keptPoints;
    frontLength += other.frontLength;
    moves += other.moves;
    requests += other.requests;
    errorPx = std::max(errorPx, other.errorPx);
    thresholdPx = std::max(thresholdPx, other.thresholdPx);
    frontMilliseconds += other.frontMilliseconds;
    gpuBytes = std::max(gpuBytes, other.gpuBytes);
    windowGpuBytes = std::max(windowGpuBytes, other.windowGpuBytes);
    technique = technique == other.technique ? technique : std::string();
    complete = complete && other.complete;
    limitedByPoints = limitedByPoints || other.limitedByPoints;
    limitedByGpuMemory = limitedByGpuMemory || other.limitedByGpuMemory;
    limitedByMemory = limitedByMemory || other.limitedByMemory;
    layersLeftOut.insert(
      layersLeftOut.end(), other.layersLeftOut.begin(), other.layersLeftOut.end());
    failedNodes = std::max(failedNodes, other.failedNodes);
  }
};

} // namespace pointfront
