#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pointfront
{

/// A record of one frame: its counts, and where the loading stands after it; sums over the stores.
struct FrameRecord
{
  double milliseconds = 0.0; ///< time of the whole frame, drawing finished
  double frontMilliseconds = 0.0; ///< time of the fronts' updates
  /// From the plans to the pixels, the points alone; nothing where a driver draws beside the rest.
  std::optional<double> rasteriseMilliseconds;
  std::int64_t points = 0;
  /// The points by class code, of stores with a tree for each class.
  std::map<std::uint8_t, std::int64_t> classPoints;
  std::int64_t nodes = 0;
  std::int64_t frontLength = 0;
  std::int64_t moves = 0;
  std::int64_t requests = 0;
  double thresholdPx = 0.0; ///< largest
  double errorPx = 0.0; ///< largest
  /// How points became pixels, as MeasuredTechnique says it; empty: not measured.
  std::string technique;
  bool complete = false; ///< no further frame will change the picture
  /// A complete picture shows a point in a pixel at least. Points that were drawn may all be hidden
  /// by a condition, or lie beside the view.
  bool showsPoints = false;
  bool limitedByPoints = false; ///< --point-budget kept the error above --error
  bool limitedByGpu = false; ///< --gpu-memory did
  bool limitedByMemory = false; ///< --memory did
  /// "class 2", or the path of a store without a tree for each class: of which --gpu-memory or
  /// --point-budget let nothing be drawn, though it is in view.
  std::set<std::string> leftOut;
  std::int64_t failedNodes = 0; ///< that could not be read
  std::int64_t gpuBytes = 0;
  std::uint64_t residentBytes = 0;
  std::uint64_t threadReadBytes = 0; ///< that the rendering thread read from files in this frame
  std::uint64_t bytesRead = 0; ///< from the disk, ever
  std::uint64_t cancelled = 0; ///< requests withdrawn, ever

  /// One part of a picture more, drawn after this one: what it took and asked adds up, the worst
  /// error counts, and what is in memory is what is now.
  void add(const FrameRecord& part);
};

/// A complete picture without a point (FrameRecord::showsPoints) is none.
Error noPointShown();
/// Nor is one for which --gpu-memory is too small: a node takes 4,096 points' room at least.
Error noNodeOnGpu();

/// Adds to FrameRecord::leftOut what FrontDelta::layersLeftOut says of a store.
void noteLeftOut(
  const std::vector<std::uint16_t>& layers, const StoreDescription& store, FrameRecord& frame);
/// "class 2, class 9 and 3 others"; `names` is not empty.
std::string leftOutText(const std::set<std::string>& names);

/// Adds the points of a store's layers, where each layer is a class.
void countClasses(
  const std::vector<std::uint64_t>& layerPoints, const StoreDescription& store, FrameRecord& frame);

} // namespace pointfront
