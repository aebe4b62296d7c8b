#pragma once

#include "KeptSplats.h"
#include "SplatComposition.h"
#include "SplatFrame.h"
#include "SplatGroups.h"
#include "SplatTarget.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>

namespace pointfront
{

/// A plan, or a part of one, drawn by GL into targets of its own: the twin of SoftwareRasteriser.
/// Passes    who is seen in each pixel (the nearest; of splats that overlap the one with the
///           nearest centre), then weights and colours of what is not behind it, then light and
///           eye-dome lighting.
/// Motion    what the last pictures showed is kept (FramePlan::keepsVisible) where the last one is
///           still there: no other cloud has drawn into the target since.
/// Threads   that of the GL context, current in all functions.
/// Source    docs/adr/0016, 0028.
class SplatPart
{
public:
  /// Returned instead of a number of points: GL has no room for the targets, or cannot draw into
  /// them.
  static constexpr std::int64_t noTarget = -1;

  explicit SplatPart(SplatTools& tools);
  ~SplatPart();

  /// Draws the points of the plan that are on the GPU, except those that the last picture has, and
  /// returns their number. `limits`: the wanted pixels, all of which get a value; null: only the
  /// pixels of shown() do.
  std::int64_t draw(const SplatFrame& frame, const FramePlan& plan,
    const std::shared_ptr<SplatTarget>& target, const PixelRectangle* limits);
  /// The rectangle in which the points of the last picture can show anything.
  const PixelRectangle& shown() const { return seen_; }
  SplatTextures picture() const;
  /// Points of the last picture that were drawn beside the plan's (FramePlan::keepsVisible).
  std::int64_t keptPoints() const { return kept_.points(); }
  /// Gives the target back too; the next drawing begins anew.
  void release(vtkOpenGLRenderWindow* window);

private:
  void forget();
  PixelRectangle placeOf(const FramePlan& plan, bool fills) const;
  void keepVisible(const SplatFrame& frame, const FramePlan& plan, float largestPointPx);
  bool drawInto(const SplatFrame& frame, const FramePlan& plan, bool goesOn, bool fills);
  void drawGroups(const SplatFrame& frame, bool second, bool addedOnly);
  void drawGroup(
    const SplatFrame& frame, const SplatGroups::Group& group, const DrawRuns& runs, bool second);
  /// `fills`: what was seen is SplatTools::holes'.
  void resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan, bool fills);

  SplatTools& tools_;
  std::shared_ptr<SplatTarget> target_; ///< all clouds of the window may draw into it in turn
  SplatTarget::Parts parts_;
  SplatGroups groups_;
  KeptSplats kept_;
  bool selects_ = false; ///< the last picture is for a selection
  FrameShading shading_; ///< shading of the last picture
  bool fills_ = false; ///< the last picture's holes are filled
  bool composited_ = false; ///< likewise: it has the depths that decided
  vtkRenderer* renderer_ = nullptr; ///< compared, not used
  PixelRectangle limits_;
  PixelRectangle shown_; ///< the pixels that get a value
  PixelRectangle seen_; ///< where points can be seen
};

} // namespace pointfront
