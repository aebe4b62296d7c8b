#pragma once

#include "KeptSplats.h"
#include "SplatComposition.h"
#include "SplatFrame.h"
#include "SplatGroups.h"
#include "SplatStandIns.h"
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
/// Loading   a refining view has stand-ins (FramePlan::standIns), but for selections.
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
  /// The needs of a picture.
  struct Demand
  {
    bool goesOn = false; ///< with what is in the target
    bool fills = false;
    bool standIns = false;
    bool mayChange = false; ///< sums of blended splats need not be those of one go
  };
  std::int64_t list(
    const SplatFrame& frame, const FramePlan& plan, const PixelRectangle& within, Demand& demand);
  void forget();
  PixelRectangle placeOf(const FramePlan& plan, bool fills, bool standIns) const;
  void keepVisible(const SplatFrame& frame, const FramePlan& plan, float largestPointPx);
  /// One pass over the points.
  struct Pass
  {
    DrawRuns SplatGroups::Group::*runs;
    SplatTarget::Parts parts;
    vtkTextureObject* seenDepths; ///< null: the first pass
    /// The smaller id is seen of two points at one depth, though groups are drawn one after the
    /// other. Otherwise it is the point that is drawn first.
    bool byIds = false;
    bool follows = false; ///< likewise, though the target has points of earlier frames
  };
  bool isSame(const FramePlan& plan, const Demand& demand) const;
  bool drawInto(const SplatFrame& frame, const FramePlan& plan, const Demand& demand);
  void drawGroups(const SplatFrame& frame, Pass pass);
  void drawGroup(const SplatFrame& frame, const SplatGroups::Group& group, const Pass& pass);
  void addSums(const SplatFrame& frame, bool goesOn);
  void forgetHidden(const SplatFrame& frame);
  /// Puts what has not grown to its size over what is seen; returns the sums with it.
  vtkTextureObject* addGrowing(const SplatFrame& frame, SeenTextures& seen);
  /// `fills`: what was seen is SplatTools::holes'.
  void resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan, const SeenTextures& seen,
    vtkTextureObject* sums, bool fills);

  SplatTools& tools_;
  std::shared_ptr<SplatTarget> target_; ///< all clouds of the window may draw into it in turn
  SplatTarget::Parts parts_;
  SplatGroups groups_;
  KeptSplats kept_;
  SplatStandIns standIns_;
  bool selects_ = false; ///< the last picture is for a selection
  FrameShading shading_; ///< shading of the last picture
  bool fills_ = false; ///< the last picture's holes are filled
  bool hasStandIns_ = false; ///< likewise: it has stand-ins
  bool hasGrowing_ = false; ///< likewise: it has points that have not grown to their size
  bool summed_ = false; ///< the target has the sums of the last picture
  bool exact_ = false; ///< they are those of one go
  bool composited_ = false; ///< likewise: it has the depths that decided
  vtkRenderer* renderer_ = nullptr; ///< compared, not used
  PixelRectangle limits_;
  PixelRectangle shown_; ///< the pixels that get a value
  PixelRectangle seen_; ///< where points can be seen
};

} // namespace pointfront
