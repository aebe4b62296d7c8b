#pragma once

#include "RasterKernels.h"

#include "pointfront/Plan/FramePlan.h"

namespace pointfront
{

/// A style as the loops draw it: one pass over the points, or two where splats are blended.
struct TechniquePasses
{
  bool squares = false; ///< squares of `squareSize` pixels; else splats by `first`
  int squareSize = 1;
  SplatPass first;
  float firstRadius = 1.0f; ///< factor of the radius that closes the surface
  bool blended = false;
  SplatPass second;
  float secondRadius = 1.0f;

  bool walls() const { return !squares && first.shape == SplatShape::Wall; }
  /// The key's depth is the point's, not one that was pushed back to let nearer centres win.
  bool depthInKey() const { return squares || (first.paraboloid == 0.0f && !first.rimmed()); }
};

/// How points that are drawn were chosen, where more are there and the node does not say how far
/// the chosen ones are apart.
enum class Thinning
{
  None, ///< all are drawn, or as many as the node says
  Even, ///< among evenly thinned points
  Random ///< from a root, whose first points have nothing between them
};

/// The conditions of a frame that decide about passes, beside a style.
struct PassConditions
{
  bool hasNormals = false; ///< the drawn node has normals
  float spacingPx = 0.0f; ///< FramePlan's
  Thinning thinning = Thinning::None;
  int heightPx = 1; ///< height of the viewport
};

/// Edge of a square of a point, in whole pixels: every point has as many.
int squareSizeOf(double pixels);
/// The edge of one that grows (PointGrowth); 0: it is not drawn. Twin: setUp() in SplatSetUp.glsl.
int grownSquare(int size, float grown);

/// Constants  as measured against ground truth: docs/adr/0016.
TechniquePasses passesOf(const ResolvedStyle& style, const PassConditions& conditions);
/// Solid: of the walls below the points.
TechniquePasses wallPassesOf(const ResolvedStyle& style, const PassConditions& conditions);

bool operator==(const TechniquePasses& a, const TechniquePasses& b);

} // namespace pointfront
