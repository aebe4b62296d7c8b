#pragma once

#include "RasterKernels.h"

#include "pointfront/Plan/FramePlan.h"

namespace pointfront
{

/// What a style comes to in the loops: one pass over the points, or two where splats are blended.
struct TechniquePasses
{
  bool squares = false; ///< of `squareSize` pixels; else splats by `first`
  int squareSize = 1;
  SplatPass first;
  float firstRadius = 1.0f; ///< of the radius that closes the surface
  bool blended = false;
  SplatPass second;
  float secondRadius = 1.0f;

  bool walls() const { return !squares && first.shape == SplatShape::Wall; }
  /// The key's depth is the point's, not one that was pushed back to let nearer centres win.
  bool depthInKey() const { return squares || (first.paraboloid == 0.0f && !first.rimmed()); }
};

/// What of a frame decides about passes, beside a style.
struct PassConditions
{
  bool hasNormals = false; ///< of the node that is drawn
  float spacingPx = 0.0f; ///< FramePlan's
  /// More points are there than are drawn, and the node does not say how far those are apart.
  bool thinned = false;
  int heightPx = 1; ///< of the viewport
};

/// Constants  as measured against ground truth: docs/adr/0016.
TechniquePasses passesOf(const ResolvedStyle& style, const PassConditions& demand);
/// Solid: of the walls below the points.
TechniquePasses wallPassesOf(const ResolvedStyle& style, const PassConditions& demand);

bool operator==(const TechniquePasses& a, const TechniquePasses& b);

} // namespace pointfront
