#pragma once

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The points of a plan that are drawn into a picture of their own before all pictures are composed
/// (LAYERS-9).
struct PlanPart
{
  std::int16_t lens = -1; ///< the lens in FrameShading::lenses that it is seen in; -1: outside all
  bool mask = false; ///< the covered pixels are those of the lens
  std::uint16_t group = 0; ///< 0: opaque
  double opacity = 1.0;
  FramePlan plan; ///< its batches; all else as the whole's

  friend bool operator<(const PlanPart& a, const PlanPart& b)
  {
    return a.lens != b.lens ? a.lens < b.lens
      : a.mask != b.mask    ? a.mask < b.mask
                            : a.group < b.group;
  }
};

/// False if the plan is one part: all points are opaque and outside of lenses.
bool isComposed(const FramePlan& plan);

/// The parts of a plan, in order. Outside of lenses: the opaque part, which always exists, then
/// each translucent group. Then for each lens: its opaque part, which always exists, its
/// translucent groups, and its mask.
std::vector<PlanPart> partsOf(const FramePlan& plan);

/// One step from the pictures of the parts to the picture of the whole.
struct CompositionStep
{
  enum class Kind
  {
    BlendGroups, ///< translucent groups over the opaque picture of the same place, far to near
    PutLens, ///< the inside of a lens in place of the pixels that it covers
    Highlight ///< tints, then rims
  };
  Kind kind;
  std::int16_t lens = -1; ///< where: inside of that lens; -1: outside all
};

/// The steps in order: what every back end does, and all that it does, with pictures of parts. Each
/// part was lit, its holes filled and its depths shaded before (docs/adr/0029).
std::vector<CompositionStep> compositionOf(const FrameShading& shading);

} // namespace pointfront
