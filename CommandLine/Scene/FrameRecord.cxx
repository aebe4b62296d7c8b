#include "FrameRecord.h"

#include "pointfront/Style/StyleSheet.h"

#include <algorithm>
#include <string>

namespace pointfront
{
namespace
{

constexpr std::size_t mostNamed = 5; ///< that a warning names

} // namespace

void FrameRecord::add(const FrameRecord& part)
{
  milliseconds += part.milliseconds;
  frontMilliseconds += part.frontMilliseconds;
  rasteriseMilliseconds =
    rasteriseMilliseconds.value_or(0.0) + part.rasteriseMilliseconds.value_or(0.0);
  points += part.points;
  for (const auto& [code, drawn] : part.classPoints)
  {
    classPoints[code] += drawn;
  }
  nodes += part.nodes;
  frontLength = std::max(frontLength, part.frontLength);
  moves += part.moves;
  requests += part.requests;
  thresholdPx = std::max(thresholdPx, part.thresholdPx);
  errorPx = std::max(errorPx, part.errorPx);
  complete = complete && part.complete;
  showsPoints = showsPoints || part.showsPoints;
  limitedByPoints = limitedByPoints || part.limitedByPoints;
  limitedByGpu = limitedByGpu || part.limitedByGpu;
  limitedByMemory = limitedByMemory || part.limitedByMemory;
  leftOut.insert(part.leftOut.begin(), part.leftOut.end());
  failedNodes = std::max(failedNodes, part.failedNodes);
  gpuBytes = std::max(gpuBytes, part.gpuBytes);
  residentBytes = part.residentBytes;
  threadReadBytes += part.threadReadBytes;
  bytesRead = part.bytesRead;
  cancelled = part.cancelled;
}

Error noPointShown()
{
  return makeError(Error::Kind::BadArgument,
    "no point is in the picture, which is not written; "
    "look elsewhere (--camera, --view), or choose other points");
}

Error noNodeOnGpu()
{
  return makeError(Error::Kind::BadArgument,
    "no point is in the picture, which is not written: --gpu-memory has no room for a single node; "
    "raise it");
}

void noteLeftOut(
  const std::vector<std::uint16_t>& layers, const StoreDescription& store, FrameRecord& frame)
{
  for (const std::uint16_t layer : layers)
  {
    const bool named = isLayered(store) && layer < store.layers.size();
    frame.leftOut.insert(
      named ? "class " + std::to_string(store.layers[layer].objectClass) : store.path);
  }
}

std::string leftOutText(const std::set<std::string>& names)
{
  const std::size_t named = names.size() <= mostNamed + 1 ? names.size() : mostNamed;
  std::string text;
  std::size_t i = 0;
  for (auto name = names.begin(); i < named; ++name, ++i)
  {
    const bool last = i + 1 == names.size();
    text += (i == 0 ? "" : (last ? " and " : ", ")) + *name;
  }
  return named < names.size() ? text + " and " + std::to_string(names.size() - named) + " others"
                              : text;
}

void countClasses(
  const std::vector<std::uint64_t>& layerPoints, const StoreDescription& store, FrameRecord& frame)
{
  for (std::size_t layer = 0; isLayered(store) && layer < store.layers.size(); ++layer)
  {
    const auto code = static_cast<std::uint8_t>(store.layers[layer].objectClass);
    frame.classPoints[code] +=
      layer < layerPoints.size() ? static_cast<std::int64_t>(layerPoints[layer]) : 0;
  }
}

} // namespace pointfront
