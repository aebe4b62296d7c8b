#pragma once

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Where a camera will be `frames` frames after `now`, if it goes on as from `before` to `now`: the
/// eye moves on, the planes of the frustum turn on, the size of things on the screen changes on by
/// the same factor (at most fourfold). The same view if it stands still.
/// Two views of different kinds (parallel and not) or viewports tell nothing: `now` comes back.
View viewAhead(const View& before, const View& now, double frames);

/// What a moving view is about to need: loaded ahead as far as memory is free, so that what comes
/// into sight is there already.
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

  /// Nodes that are absent and that the view ahead shows above `thresholdPx`, all optional, largest
  /// error first, ties by node; at most `most`. `frames`: how far ahead. Call it once a frame.
  /// Valid until the next call.
  /// Layers as in FrontLimits.
  const std::vector<LoadRequest>& requests(const View& now, double thresholdPx,
    const ResidencyView& residency, double frames, std::uint32_t most,
    const std::vector<LayerLimits>& layers = {});

  /// Instead of requests(), for a frame that is not part of a motion.
  void rest(const View& now);

  static constexpr std::uint32_t visitLimit = 4096;

private:
  void visit(NodeIndex index, const View& ahead, const LayerLimits& layer, double thresholdPx,
    const ResidencyView& residency);

  std::shared_ptr<const Hierarchy> hierarchy_;
  std::vector<LoadRequest> requests_;
  View before_;
  bool first_ = true;
  std::uint32_t visits_ = 0;
};

} // namespace pointfront
