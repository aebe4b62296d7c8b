#include "Settling.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace pointfront
{

Settling::Settling(const StoreScene& scene)
  : begin_(Clock::now())
  , before_(scene.loading())
  , after_(before_)
{
}

void Settling::note(const StoreScene& scene, const FrameRecord& frame)
{
  completeMs_ = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
  drawingMs_ += frame.milliseconds;
  after_ = scene.loading();
  last_ = frame;
  ++frames_;
}

nlohmann::ordered_json Settling::json() const
{
  nlohmann::ordered_json object;
  object["ms"] = completeMs_;
  const std::chrono::duration<double, std::milli> loading = after_.last - begin_;
  object["loaded_ms"] = std::max(0.0, loading.count());
  object["drawing_ms"] = drawingMs_;
  object["frames"] = frames_;
  object["complete"] = last_.complete;
  object["points_drawn"] = last_.points;
  object["error_px"] = last_.errorPx;
  object["limited_by_points"] = last_.limitedByPoints;
  object["limited_by_gpu_memory"] = last_.limitedByGpu;
  object["limited_by_memory"] = last_.limitedByMemory;
  object["bytes_read"] = after_.fetchedBytes - before_.fetchedBytes;
  object["bytes_decoded"] = after_.decodedBytes - before_.decodedBytes;
  object["read_seconds"] = after_.fetchSeconds - before_.fetchSeconds;
  object["decode_cpu_seconds"] = after_.decodeSeconds - before_.decodeSeconds;
  return object;
}

} // namespace pointfront
