#pragma once

#include "PixelRectangle.h"
#include "SplatFrame.h"
#include "SplatTarget.h"

#include "pointfront/Plan/FramePlan.h"

#include <functional>
#include <map>
#include <memory>

class vtkOpenGLRenderWindow;

namespace pointfront
{

/// The stand-ins of a refining view (FramePlan::standIns), each level in a target of its own that
/// goes on from frame to frame: a point that is no longer seen hides nothing coarser.
/// Bytes    24 a pixel and level, with light 16 more; up to five levels, and no more than some
///          8 million pixels or a viewport. Levels beyond share a target.
/// Threads  that of the GL context, which is current in all functions but the constructor.
/// Twin     SoftwareRasteriser::Content::drawStandIns().
/// Source   docs/adr/0043.
class SplatStandIns
{
public:
  SplatStandIns();
  ~SplatStandIns();

  /// Lists the plan's stand-ins that are on the GPU. `samePlace`: renderer and limits are those of
  /// the last frame. `lit`: what is seen has normals.
  void list(
    const SplatFrame& frame, const FramePlan& plan, float largestPointPx, bool samePlace, bool lit);
  bool empty() const { return levels_.empty(); }
  /// Whether they differ from those of the last list.
  bool changed() const { return changed_; }
  /// The rectangle in which the stand-ins can show anything.
  const PixelRectangle& shown() const { return shown_; }

  /// Draws those that are new, within `limits`, and puts them behind what is seen; `parts` of it.
  /// Where GL has no room for a target, holes stay until the view is complete.
  SeenTextures over(const SplatFrame& frame, SplatTools& tools, const SplatTarget::Parts& parts,
    const PixelRectangle& limits, SeenTextures seen);

  /// All are drawn anew next time.
  void forget();
  void release(vtkOpenGLRenderWindow* window);

private:
  struct Level;
  /// Levels from fine to coarse; those that share a target have number 0.
  using Levels = std::map<int, std::unique_ptr<Level>, std::greater<int>>;

  static std::map<int, FramePlan> plansOf(const FramePlan& plan);
  static void number(Level& level);
  bool draw(const SplatFrame& frame, SplatTools& tools, const PixelRectangle& limits, Level& level);

  Levels levels_;
  SplatTarget::Parts parts_; ///< parts of a level
  PixelRectangle shown_;
  bool changed_ = false;
};

} // namespace pointfront
