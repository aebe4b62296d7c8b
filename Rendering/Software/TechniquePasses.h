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
  float firstRadius = 1.0f;  ///< of the radius that closes the surface
  bool blended = false;
  SplatPass second;
  float secondRadius = 1.0f;

  /// The key's depth is the point's, not one that was pushed back to let nearer centres win.
  bool depthInKey() const { return squares || first.paraboloid == 0.0f; }
};

/// `hasNormals`: of the node that is drawn. `spacingPx`: FramePlan's. `heightPx`: of the viewport.
/// Constants  as measured against ground truth: docs/adr/0016.
TechniquePasses passesOf(
  const ResolvedStyle& style, bool hasNormals, float spacingPx, int heightPx);

bool operator==(const TechniquePasses& a, const TechniquePasses& b);

} // namespace pointfront
