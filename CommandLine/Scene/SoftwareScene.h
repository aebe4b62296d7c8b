#pragma once

#include "DrawnStores.h"
#include "PictureMemory.h"
#include "StoreScene.h"
#include "ThreadReads.h"

#include "SoftwareComposition.h"
#include "SoftwareRasteriser.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A scene that the software rasteriser draws: no X, no EGL, no GL, no VTK.
/// Memory   --memory is for decoded points and the picture together; a complete picture that would
///          take more than half of it is drawn in bands.
/// Source   docs/adr/0020.
class SoftwareScene final : public StoreScene
{
public:
  static Result<std::unique_ptr<SoftwareScene>> open(const DrawingOptions& options);

  const char* backend() const override { return "software"; }
  const Bounds& bounds() const override { return stores_.bounds(); }
  std::vector<std::string> warnings() const override { return stores_.warnings(); }
  Result<double> ground() const override;
  void setCamera(const Camera& camera) override;
  void setInteractive(bool interactive) override { interactive_ = interactive; }
  Result<FrameRecord> renderFrame() override { return render(false); }
  Result<FrameRecord> renderComplete() override { return render(true); }
  bool needsBands() const override { return memory_->needsBands(); }
  Result<FrameRecord> renderInBands(const std::string& path) override;
  bool waitForArrival() override { return stores_.waitForArrival(); }
  std::vector<std::string> attributesRead() const override { return stores_.attributesRead(); }
  std::uint64_t budgetBytes() const override { return memory_->budgetBytes(); }
  std::uint64_t residentBytesMax() const override;
  LoadingRecord loading() const override { return stores_.loading(); }
  std::uint64_t emptySceneBytes() const override { return emptySceneBytes_; }
  std::uint64_t pictureBytes() const override;
  Result<void> writePicture(const std::string& path) override;

  /// Frames from now on have that size; what they keep of earlier ones is as good as before. The
  /// camera is to be set again.
  /// Errors  NoMemory: --memory is too little for such a picture.
  Result<void> resize(std::array<int, 2> size);
  /// The last frame: opaque, row 0 is the lowest.
  const SoftwareTarget& picture() const { return target_; }
  /// A stored point that is seen: of which of the stores, and its number there.
  struct SeenPoint
  {
    std::size_t store = 0;
    std::uint64_t id = 0;
  };
  /// The point in the pixel, or in the one that is nearest to it and at most `reach` pixels away;
  /// of what is in memory. Column from the left, row from below. Draws the frame once more.
  Result<std::optional<SeenPoint>> pick(const std::array<int, 2>& pixel, int reach);
  const DrawnStore& store(std::size_t number) const { return stores_[number]; }
  /// Something arrived that the last frame did not have, or that frame left work over. Cheap; moves
  /// the fronts.
  bool needsFrame() { return stores_.needsFrame(); }
  /// Something is on its way from the disk.
  bool loads() const { return stores_.loads(); }

private:
  struct DrawnNodes;
  explicit SoftwareScene(const DrawingOptions& options);
  Result<void> shareMemory();
  FrameRequest frameRequest(const View& view, bool complete) const;
  FrameRecord updateFronts(const View& view, bool complete);
  void drawPart(SoftwareRasteriser& rasteriser, const PixelRectangle& place, FrameRecord& frame);
  Result<FrameRecord> render(bool complete);
  Result<FrameRecord> renderBand(
    SoftwareRasteriser& rasteriser, const PixelRectangle& rows, DrawnNodes& drawn);
  double reachRows() const;

  DrawingOptions options_;
  std::optional<PictureMemory> memory_; ///< once it is open
  FrameShading shading_;
  FrameCamera camera_;
  bool interactive_ = false;
  std::uint64_t emptySceneBytes_ = 0;
  std::vector<double> ownMs_; ///< time that each store took of the frame in work
  ThreadReads reads_;
  DrawnStores stores_;
  std::unique_ptr<ThreadCrew> crew_; ///< where memory allows a frame fewer threads than there are
  std::unique_ptr<SoftwareRasteriser> rasteriser_;
  SoftwareComposition composition_;
  SoftwareTarget target_;
};

} // namespace pointfront
