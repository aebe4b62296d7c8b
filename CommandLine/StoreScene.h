#pragma once

#include "Camera.h"
#include "DrawingOptions.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// What one frame drew, and where the loading stands after it; sums over the stores.
struct FrameRecord
{
  double milliseconds = 0.0;      ///< of the whole frame, drawing finished
  double frontMilliseconds = 0.0; ///< of the fronts' updates
  std::int64_t points = 0;
  std::int64_t nodes = 0;
  std::int64_t frontLength = 0;
  std::int64_t moves = 0;
  std::int64_t requests = 0;
  double thresholdPx = 0.0;       ///< largest
  double errorPx = 0.0;           ///< largest
  bool complete = false;          ///< no further frame will change the picture
  bool limitedByPoints = false;   ///< --point-budget kept the error above --error
  bool limitedByGpu = false;      ///< --gpu-memory did
  bool limitedByMemory = false;   ///< --memory did
  std::int64_t failedNodes = 0;   ///< that could not be read
  std::int64_t gpuBytes = 0;
  std::uint64_t residentBytes = 0;
  std::uint64_t threadReadBytes = 0; ///< that the rendering thread read from files in this frame
  std::uint64_t bytesRead = 0;    ///< from the disk, ever
  std::uint64_t cancelled = 0;    ///< requests withdrawn, ever
};

/// What all the loading of a scene came to so far.
struct LoadingRecord
{
  std::uint64_t fetchedBytes = 0;
  std::uint64_t decodedBytes = 0;
  double fetchSeconds = 0.0;  ///< one read at a time
  double decodeSeconds = 0.0; ///< CPU time of all threads
  std::chrono::steady_clock::time_point last; ///< when the last of it was there
};

/// Stores in an offscreen window, drawn as any VTK program would draw them: a reader, a mapper and
/// an actor each. Errors that VTK objects report while rendering become Errors here.
/// Threads  one thread.
class StoreScene
{
public:
  /// Errors  of the stores; Unsupported without an X server; BadArgument for a colour that no
  ///         store has.
  static Result<std::unique_ptr<StoreScene>> open(const DrawingOptions& options);
  virtual ~StoreScene() = default;

  virtual const Bounds& bounds() const = 0;
  virtual double ground() const = 0; ///< median z of a sample of the points
  virtual void setCamera(const Camera& camera) = 0;
  /// In motion the fronts hold the frame time that VTK allots to a moving view.
  virtual void setInteractive(bool interactive) = 0;

  /// One frame of what is there; never waits for the disk.
  virtual Result<FrameRecord> renderFrame() = 0;
  /// Waits for all that the error and the budgets allow.
  virtual Result<FrameRecord> renderComplete() = 0;
  /// Blocks until something arrives that the last frame did not have, or nothing is on its way;
  /// false for the latter.
  virtual bool waitForArrival() = 0;

  /// Attributes that were read for the drawing, by name.
  virtual std::vector<std::string> attributesRead() const = 0;
  virtual std::uint64_t budgetBytes() const = 0;
  virtual std::uint64_t residentBytesMax() const = 0;
  virtual LoadingRecord loading() const = 0;
  /// Resident set of the process when the window had drawn nothing yet but its background, and no
  /// store was open.
  virtual std::uint64_t emptySceneBytes() const = 0;

  /// The last frame as PNG; whole or absent.
  virtual Result<void> writePicture(const std::string& path) = 0;
};

} // namespace pointfront
