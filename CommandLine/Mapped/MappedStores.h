#pragma once

#include "DrawingOptions.h"
#include "ErrorListener.h"
#include "StoreScene.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <vector>

class vtkCamera;
class vtkProp;
class vtkRenderer;
class vtkRenderWindow;

namespace pointfront
{

class LoadScheduler;
class Residency;

/// Stores that VTK draws, a mapper and an actor each, in one renderer: what the pictures of
/// `render --backend opengl` and the window of `view` are made of.
/// Threads  the renderer's.
class MappedStores
{
public:
  MappedStores();
  ~MappedStores();
  MappedStores(const MappedStores&) = delete;
  MappedStores& operator=(const MappedStores&) = delete;

  /// Opens the stores of the options in the place of those of before, and hides the classes that
  /// are not asked for.
  /// Errors  of the stores; BadArgument: no store has any of the classes. Those of before stay.
  Result<void> open(const DrawingOptions& options);
  /// Sets how they are drawn, colours and styles, classes and budgets, and adds them to the
  /// renderer. Can be called again with other options of the same stores. `backend`  one of
  /// vtkPointFrontMapper::Backends. Errors     BadArgument: no store has the attribute that gives
  /// the colour, or any of the
  ///            classes.
  Result<void> show(const DrawingOptions& options, int backend, vtkRenderer* renderer);

  const Bounds& bounds() const { return bounds_; }
  /// Some store is the preview of a running build.
  bool growing() const;
  /// True if a preview has become its next version, or the finished store, since the last call: the
  /// mapper draws that now, and the bounds may be others.
  bool follow();
  std::vector<std::shared_ptr<const StoredCloud>> clouds() const;
  /// The cloud that the actor draws now; null for another prop.
  std::shared_ptr<const StoredCloud> cloudOf(const vtkProp* prop) const;
  /// Warnings of the clouds about themselves, with their paths.
  std::vector<std::string> warnings() const;
  /// The camera, with clipping planes that hold all stores.
  void aim(const Camera& camera, vtkCamera* target) const;
  void setPointBudget(std::int64_t points);

  /// Draws a frame of the window, which must have the renderer, and waits for the driver.
  /// `complete`  waits for all that the error and the budgets allow; else draws what is there.
  void draw(vtkRenderWindow* window, bool complete);
  /// The counts of the last frame, without its times.
  FrameRecord record() const;
  /// Another frame would show something that the last one did not.
  bool needsRender() const;
  /// Something is on its way to memory. Null: nothing is.
  const Residency* loading() const;
  /// Some points cannot be read, and errors() tells why. The others can be drawn.
  bool lacksPoints() const;
  /// Attributes that were read, by name.
  std::vector<std::string> attributesRead() const;
  /// The one scheduler that loads all stores.
  const LoadScheduler& scheduler() const;
  /// Hears the errors of readers and mappers.
  ErrorListener& errors() { return errors_; }

private:
  struct MappedStore;
  static Result<std::unique_ptr<MappedStore>> openStore(
    const std::string& path, ErrorListener& errors);
  Result<void> hideOtherClasses(const DrawingOptions& options);

  ErrorListener errors_;
  bool hidden_ = false; ///< some classes are, by their trees
  Bounds bounds_;
  std::string lightDoubt_;
  std::vector<std::unique_ptr<MappedStore>> stores_;
};

} // namespace pointfront
