#pragma once

#include "SoftwareTarget.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>

namespace pointfront
{
class ThreadCrew;

/// What a drawing came to.
struct RasterStatistics
{
  std::uint64_t points = 0; ///< of the plan, that were looked at
  std::uint64_t reused = 0; ///< of the plan, that the last picture already had
  /// Drawn beside the plan's, as they were visible before (FramePlan::keepsVisible).
  std::uint64_t keptVisible = 0;
  double milliseconds = 0.0; ///< wall time
};

/// Draws plans without GL, driver or VTK: the back end for machines without a GPU, and the
/// reference that shaders are compared with.
/// Determinism  the same plan gives the same bits for any number of threads, any order of batches
///              and items, on each instruction set, and in one go or by and by (a plan that only
///              adds points to the one before adds them to what is there). Pictures of plans that
///              keep what was visible depend on the pictures before them.
/// Memory       some buffers of the size of what a plan shows on the viewport, kept from frame to
///              frame; one more for each further thread; with several stores, up to `keptPictures`
///              more.
/// Threads      one thread at a time; draws with those of a crew.
/// Source       docs/adr/0016.
class SoftwareRasteriser
{
public:
  /// Keys of so many viewports stay from frame to frame, of all stores; of stores beyond that only
  /// marks of who was visible do.
  static constexpr int keptPictures = 2;

  /// Draws with the process's crew, unless another is given; it outlives this object.
  explicit SoftwareRasteriser(ThreadCrew* crew = nullptr);
  ~SoftwareRasteriser();
  SoftwareRasteriser(const SoftwareRasteriser&) = delete;
  SoftwareRasteriser& operator=(const SoftwareRasteriser&) = delete;

  /// Draws the plan into the target where it is nearer than what is there; ties leave what is
  /// there. The target is the camera's viewport or a part of it: a large picture is drawn in bands,
  /// each with the splat sizes of the whole. `store` becomes PixelPoint::store; each store goes on
  /// from its own last picture, and so does each `part` of its plans.
  RasterStatistics draw(
    const FramePlan& plan, SoftwareTarget& target, std::uint16_t store = 0, std::uint16_t part = 0);
  /// Makes the target that part of the viewport in which the plan can show anything, empty if there
  /// is none, and draws into it.
  RasterStatistics drawShown(
    const FramePlan& plan, SoftwareTarget& target, std::uint16_t store = 0);

  /// Forgets the last picture and gives its memory back.
  void release();

  /// The instruction set in use: "AVX-512", "AVX2" or "portable". The best that the processor has,
  /// unless POINTFRONT_INSTRUCTIONS in the environment names another.
  const char* instructionSet() const;
  /// For tests and measurements; false, and nothing changes, if it cannot be had here.
  bool setInstructionSet(const char* name);

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// What a strength of 1 means: with 0.4, the usual one, a step of 1 % in depth darkens by a third.
constexpr float eyeDomeGain = 300.0f;

/// The part of the viewport in which the plan can show anything.
PixelRectangle shownRectangle(const FramePlan& plan);

/// Deferred light, eye-dome lighting and the hole filler on what was drawn, by the plan's shading;
/// once, after all stores. Pixels of nothing stay so unless a hole is filled. Highlights come after
/// composition: see highlight().
void shade(const FrameCamera& camera, const FrameShading& shading, SoftwareTarget& target);

} // namespace pointfront
