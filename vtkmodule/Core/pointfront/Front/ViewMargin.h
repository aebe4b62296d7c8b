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

/// The view whose viewport has `share` of its width more at the left and at the right, and `share`
/// of its height more above and below. Things keep their size in pixels. Frusta off the axis stay
/// off the axis.
View widened(const View& now, double share);

/// The nodes that a view is about to need. They are loaded ahead as far as memory is free, so that
/// they are there when they come into sight: of a moving view where it goes, of one at rest on all
/// sides.
/// Source   Kovac 2009, section 3 (a margin around the view is loaded ahead; EWA-2).
/// Cost     one walk over at most `visitLimit` nodes of the table.
/// Threads  one.
class ViewMargin
{
public:
  explicit ViewMargin(std::shared_ptr<const Hierarchy> hierarchy)
    : hierarchy_(std::move(hierarchy))
  {
  }

  /// Absent nodes that the view `frames` frames ahead shows above `thresholdPx`: all optional,
  /// largest error first, ties by node; at most `most`; none while nothing moves. Call it once a
  /// frame. Valid until the next call. Layers as in FrontLimits.
  const std::vector<LoadRequest>& ahead(const View& now, double thresholdPx,
    const ResidencySnapshot& residency, double frames, std::uint32_t most,
    const std::vector<LayerLimits>& layers = {});

  /// The same for a view at rest: absent nodes that `widened(now, share)` shows.
  const std::vector<LoadRequest>& around(const View& now, double thresholdPx,
    const ResidencySnapshot& residency, double share, std::uint32_t most,
    const std::vector<LayerLimits>& layers = {});

  /// Instead of both, for a frame that needs no margin.
  void rest(const View& now);

  /// The last walk met rows of the table that are not in memory: there is more below them.
  bool rowsComing() const { return rowsComing_; }

  static constexpr std::uint32_t visitLimit = 4096;

private:
  void walk(const View& shown, double thresholdPx, const ResidencySnapshot& residency,
    std::uint32_t most, const std::vector<LayerLimits>& layers);
  void visit(NodeIndex index, const View& shown, const LayerLimits& layer, double thresholdPx,
    const ResidencySnapshot& residency);

  std::shared_ptr<const Hierarchy> hierarchy_;
  std::vector<LoadRequest> requests_;
  View before_;
  bool first_ = true;
  bool rowsComing_ = false;
  std::uint32_t visits_ = 0;
};

} // namespace pointfront
