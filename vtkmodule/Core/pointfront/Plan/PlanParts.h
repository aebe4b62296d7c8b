#pragma once

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// What of a plan is drawn into a picture of its own before all are composed (LAYERS-9).
struct PlanPart
{
  std::int16_t lens = -1; ///< of FrameShading::lenses, the one it is seen in; -1: outside all
  bool mask = false; ///< what it covers is what the lens covers
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

/// False: the plan is one part, all opaque and outside of lenses.
bool isComposed(const FramePlan& plan);

/// The parts of a plan, in order: outside of lenses what is opaque, which is always there; then
/// each translucent group; then the same of each lens, what is opaque always there, and its mask.
std::vector<PlanPart> partsOf(const FramePlan& plan);

} // namespace pointfront
