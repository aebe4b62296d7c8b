#pragma once

#include "SoftwareTarget.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>

namespace pointfront
{
class ThreadCrew;

/// The results of a drawing.
struct RasterStatistics
{
  std::uint64_t points = 0; ///< points of the plan
  std::uint64_t reused = 0; ///< in the last picture already, or beside all wanted pixels
  std::uint64_t standIns = 0; ///< points drawn in addition, where a refining view has holes
  /// Points that were not there, once for each style that draws them; stand-ins and kept ones too.
  std::uint64_t drawn = 0;
  std::uint64_t blended = 0; ///< points that went through the second pass, stand-ins too
  /// Points drawn in addition to the plan's, because they were visible before
  /// (FramePlan::keepsVisible).
  std::uint64_t keptVisible = 0;
  double milliseconds = 0.0; ///< wall time
};

/// The part that a plan draws of a picture that is put together of several (PlanPart).
struct RasterPart
{
  std::uint16_t number = 0;
  /// The target has all that is wanted of the part, though not the whole viewport: the inside of a
  /// lens. The next picture can then keep what was visible in it.
  bool complete = false;
};

/// Draws plans without GL, driver or VTK: the back end for machines without a GPU, and the
/// reference that shaders are compared with.
/// Determinism  the same plan gives the same bits for any number of threads, any order of batches
///              and items, on each instruction set, and in one go or step by step (a plan that only
///              adds points to the one before adds them to the last picture). Pictures of plans
///              that keep what was visible depend on the pictures before them.
/// Memory       some buffers of the size of what a plan shows on the viewport, kept from frame to
///              frame; one more for each further thread; with several stores or parts, up to
///              keptPictures() more.
/// Threads      one thread at a time; draws with those of a crew.
/// Source       docs/adr/0016.
class SoftwareRasteriser
{
public:
  /// Number of viewports of that many pixels whose keys stay from frame to frame, over all stores
  /// and parts: as many as eight million pixels have, but at least 4, and at most 64. Of further
  /// ones only marks of visible points stay. Stand-ins of refining views have half as many again
  /// beside them.
  static int keptPictures(std::int64_t viewportPixels);

  /// Draws with the process's crew, unless another is given; it outlives this object.
  explicit SoftwareRasteriser(ThreadCrew* crew = nullptr);
  ~SoftwareRasteriser();
  SoftwareRasteriser(const SoftwareRasteriser&) = delete;
  SoftwareRasteriser& operator=(const SoftwareRasteriser&) = delete;

  /// Draws the points of the plan that are nearer than the target's pixels; ties leave the pixels
  /// as they are. The target is the camera's viewport or a part of it: a large picture is drawn in
  /// bands, each with the splat sizes of the whole. `store` becomes PixelPoint::store; each store
  /// goes on from its own last picture, and so does each part of its plans, of which number 0 is
  /// the first of a picture.
  RasterStatistics draw(const FramePlan& plan, SoftwareTarget& target, std::uint16_t store = 0,
    const RasterPart& part = {});
  /// Makes the target that part of the viewport in which the plan can show anything, empty if there
  /// is none, and draws into it.
  RasterStatistics drawShown(
    const FramePlan& plan, SoftwareTarget& target, std::uint16_t store = 0);

  /// Forgets the last picture and gives its memory back.
  void release();

  /// The instruction set in use: "AVX-512", "AVX2" or "portable". The best that the processor has,
  /// unless POINTFRONT_INSTRUCTIONS in the environment names another.
  const char* instructionSet() const;
  /// For tests and measurements; false, and nothing changes, if this processor lacks the
  /// instruction set.
  bool setInstructionSet(const char* name);

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// The gain of strength 1. With the usual strength of 0.4, a step of 1 % in depth darkens by a
/// third.
constexpr float eyeDomeGain = 300.0f;

/// The part of the viewport in which the plan can show anything.
PixelRectangle shownRectangle(const FramePlan& plan);

/// Applies deferred light, eye-dome lighting and the hole filler to the drawn picture, by the
/// plan's shading; called once, after all stores. Empty pixels stay empty unless a hole is filled.
/// Highlights come after composition: see highlight(). What looks at the pixels around one sees
/// those of `others`, too; the picture is that of all processes then.
void shade(const FrameCamera& camera, const FrameShading& shading, SoftwareTarget& target,
  PictureExchange* others = nullptr);

} // namespace pointfront
