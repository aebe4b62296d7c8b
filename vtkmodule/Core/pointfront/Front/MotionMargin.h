#pragma once

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// The view `frames` frames after `now`, if the camera continues its motion from `before` to `now`:
/// the eye moves, the planes of the frustum turn, and the size of things on the screen changes by
/// the same factor (at most fourfold). A camera at rest gives the same view. If the two views
/// differ in kind (parallel or perspective) or viewport, the result is `now`.
View viewAhead(const View& before, const View& now, double frames);

/// The nodes that a moving view is about to need. They are loaded ahead as far as memory is free,
/// so that they are there when they come into sight.
/// Source   Kovac 2009, section 3 (a margin around the view is loaded ahead; EWA-2), led by the
///          motion instead of lying on all sides.
/// Cost     one walk over at most `visitLimit` nodes of the table, nothing while the view rests.
/// Threads  one.
class MotionMargin
{
public:
  explicit MotionMargin(std::shared_ptr<const Hierarchy> hierarchy)
    : hierarchy_(std::move(hierarchy))
  {
  }

  /// Absent nodes that the view ahead shows above `thresholdPx`: all optional, largest error first,
  /// ties by node; at most `most`. `frames`: how far to look ahead. Call it once a frame. Valid
  /// until the next call. Layers as in FrontLimits.
  const std::vector<LoadRequest>& requests(const View& now, double thresholdPx,
    const ResidencySnapshot& residency, double frames, std::uint32_t most,
    const std::vector<LayerLimits>& layers = {});

  /// Instead of requests(), for a frame that is not part of a motion.
  void rest(const View& now);

  static constexpr std::uint32_t visitLimit = 4096;

private:
  void visit(NodeIndex index, const View& ahead, const LayerLimits& layer, double thresholdPx,
    const ResidencySnapshot& residency);

  std::shared_ptr<const Hierarchy> hierarchy_;
  std::vector<LoadRequest> requests_;
  View before_;
  bool first_ = true;
  std::uint32_t visits_ = 0;
};

} // namespace pointfront
