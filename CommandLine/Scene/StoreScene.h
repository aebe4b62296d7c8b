#pragma once

#include "Camera.h"
#include "DrawingOptions.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// What one frame drew, and where the loading stands after it; sums over the stores.
struct FrameRecord
{
  double milliseconds = 0.0; ///< of the whole frame, drawing finished
  double frontMilliseconds = 0.0; ///< of the fronts' updates
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
  bool complete = false; ///< no further frame will change the picture
  bool limitedByPoints = false; ///< --point-budget kept the error above --error
  bool limitedByGpu = false; ///< --gpu-memory did
  bool limitedByMemory = false; ///< --memory did
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

/// Adds the points of a store's layers, where each layer is a class.
void countClasses(
  const std::vector<std::uint64_t>& layerPoints, const StoreDescription& store, FrameRecord& frame);

/// What all the loading of a scene came to so far.
struct LoadingRecord
{
  std::uint64_t fetchedBytes = 0;
  std::uint64_t decodedBytes = 0;
  double fetchSeconds = 0.0; ///< one read at a time
  double decodeSeconds = 0.0; ///< CPU time of all threads
  std::chrono::steady_clock::time_point last; ///< when the last of it was there
};

/// Stores and a camera, drawn into a picture that no screen shows: by the software rasteriser, or
/// by VTK through OpenGL (DrawingOptions::backend). What is drawn, when it is complete and what a
/// FrameRecord means is the same for both.
/// Threads  one thread.
class StoreScene
{
public:
  /// Errors  of the stores; BadArgument for a colour that no store has; Unsupported where the back
  ///         end lacks what it needs.
  static Result<std::unique_ptr<StoreScene>> open(const DrawingOptions& options);
  virtual ~StoreScene() = default;

  virtual const char* backend() const = 0; ///< "software" or "opengl"
  virtual const Bounds& bounds() const = 0;
  /// What the clouds say of themselves: that they are a part, or made of parts that differ.
  virtual std::vector<std::string> warnings() const = 0;
  /// Median z of a sample of the first store's points.
  virtual Result<double> ground() const = 0;
  virtual void setCamera(const Camera& camera) = 0;
  /// In motion the fronts hold the frame time that VTK allots to a moving view.
  virtual void setInteractive(bool interactive) = 0;

  /// One frame of what is there; never waits for the disk.
  virtual Result<FrameRecord> renderFrame() = 0;
  /// Waits for all that the error and the budgets allow.
  virtual Result<FrameRecord> renderComplete() = 0;
  /// The picture would take more than its part of the memory: instead of renderComplete() and
  /// writePicture() renderInBands() is to be called.
  virtual bool needsBands() const { return false; }
  /// The complete picture, drawn and written a band of rows at a time, each with all that the error
  /// and the budgets allow for it; whole or absent.
  /// Errors  also Cancelled, when a signal came.
  virtual Result<FrameRecord> renderInBands(const std::string& path)
  {
    const Result<FrameRecord> frame = renderComplete();
    const Result<void> written = frame ? writePicture(path) : frame.error();
    return written ? frame : written.error();
  }
  /// Blocks until something arrives that the last frame did not have, or nothing is on its way;
  /// false for the latter.
  virtual bool waitForArrival() = 0;

  /// Attributes that were read for the drawing, by name.
  virtual std::vector<std::string> attributesRead() const = 0;
  virtual std::uint64_t budgetBytes() const = 0;
  virtual std::uint64_t residentBytesMax() const = 0;
  /// Memory of the picture and of what it is drawn with; 0 where a driver has it.
  virtual std::uint64_t pictureBytes() const { return 0; }
  virtual LoadingRecord loading() const = 0;
  /// Resident set of the process when nothing was drawn yet but an empty picture, and no store was
  /// open; 0 unless DrawingOptions::measureEmptyScene.
  virtual std::uint64_t emptySceneBytes() const = 0;

  /// The last frame as PNG; whole or absent.
  virtual Result<void> writePicture(const std::string& path) = 0;
};

} // namespace pointfront
