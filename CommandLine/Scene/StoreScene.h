#pragma once

#include "Camera.h"
#include "DrawingOptions.h"
#include "FrameRecord.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The state of all loading of a scene so far.
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
  /// Warnings of the clouds about themselves: that they are a part, or made of parts that differ.
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
