#include "TechniquePasses.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

// Against ground truth (docs/adr/0016):
constexpr float visibleShare = 0.85f; ///< the share by which splats decide who is seen
constexpr float blendedShare = 1.25f; ///< for what is blended
constexpr float leastDisc = 0.71f; ///< pixels: reaches a pixel's centre wherever it lies
constexpr float leastEllipse = 0.5f; ///< its low-pass and its centre's pixel do the rest
constexpr float leastBlended = 1.0f;
constexpr float lowPassPixels = 0.5f;
constexpr float opaqueParaboloid = 8.0f; ///< radii at the rim
constexpr float blendedParaboloid = 4.0f;
constexpr float slackPixels = 2.0f;
/// Radius that closes an evenly thinned surface, in spacings: half of the inner nodes of Autzen and
/// of generated ground say less, 1.52 is the middle of ahn3_261k.
constexpr float thinnedSpacings = 1.4f;
/// The same of points chosen at random: 1.58 / 1.25 times as much, as docs/adr/0017 has it.
constexpr float randomSpacings = 1.8f;
constexpr int mostSquare = 255;
// Silhouettes: the inner part is as large as a splat, its rim goes half as far again. It is pushed
// back by more than neighbours on a slope of 70 degrees are apart in depth, so that only what is
// deeper than that gets an outline.
constexpr float rimReach = 1.5f;
constexpr float rimRadii = 2.0f;
constexpr float innerParaboloid = 3.0f; ///< radii of the inner part, of discs that face the eye
/// Paraboloid of a solid's discs that face the eye; its walls are pushed back as far, so that the
/// roof that is in front of them is seen.
constexpr float solidParaboloid = 2.0f;

SplatPass ellipsePass(SplatAccuracy accuracy)
{
  SplatPass pass;
  pass.shape = accuracy == SplatAccuracy::Affine ? SplatShape::Ellipse : SplatShape::ExactEllipse;
  pass.lowPass = accuracy == SplatAccuracy::Exact ? 0.0f : lowPassPixels;
  pass.leastRadius = leastEllipse;
  return pass;
}

SplatPass discPass(float paraboloid)
{
  SplatPass pass;
  pass.shape = SplatShape::Disc;
  pass.paraboloid = paraboloid;
  pass.leastRadius = leastDisc;
  return pass;
}

/// The second pass is the first with larger splats; what is counted in radii is counted in smaller
/// ones then.
void blend(TechniquePasses& passes, float slackRadii)
{
  passes.blended = true;
  passes.second = passes.first;
  passes.secondRadius = passes.firstRadius * (blendedShare / visibleShare);
  passes.second.paraboloid = passes.first.paraboloid * (visibleShare / blendedShare);
  passes.second.slackRadii = slackRadii * (visibleShare / blendedShare);
  passes.second.slackPixels = slackPixels;
  passes.second.leastRadius = std::max(leastBlended, passes.first.leastRadius);
}

float shareOf(const ResolvedStyle& style)
{
  return style.size.mode == SplatSize::Mode::Spacing ? visibleShare : 1.0f;
}

/// Around splats that close the surface, which stay as they are.
void addRim(TechniquePasses& passes)
{
  SplatPass& pass = passes.first;
  pass.rimFrom = 1.0f / (rimReach * rimReach);
  pass.rimRadii = rimRadii;
  pass.leastRadius *= rimReach;
  pass.paraboloid *= rimReach; // to the inner part's rim, in its radii
  passes.firstRadius *= rimReach;
}

/// How large what closes the surface is at least and at most, pixels.
void boundRadius(
  const ResolvedStyle& style, const PassConditions& conditions, float share, SplatPass& pass)
{
  if (style.size.mode != SplatSize::Mode::Spacing)
  {
    return;
  }
  const float spacings = conditions.thinning == Thinning::None ? 1.0f
    : conditions.thinning == Thinning::Even                    ? thinnedSpacings
                                                               : randomSpacings;
  const float closing =
    share * conditions.spacingPx * spacings * static_cast<float>(std::max(style.size.value, 0.0));
  pass.leastRadius = std::max(pass.leastRadius, closing);
  pass.mostRadius =
    std::max(pass.leastRadius, SplatSize::mostOfHeight * static_cast<float>(conditions.heightPx));
}

} // namespace

int squareSizeOf(double pixels)
{
  return std::clamp(static_cast<int>(std::lround(pixels)), 1, mostSquare);
}

int grownSquare(int size, float grown)
{
  return static_cast<int>(std::floor(static_cast<float>(size) * grown + 0.5f));
}

TechniquePasses passesOf(const ResolvedStyle& style, const PassConditions& conditions)
{
  const bool hasNormals = conditions.hasNormals;
  TechniquePasses passes;
  const bool pixels = style.size.mode == SplatSize::Mode::Pixels;
  if (style.technique == Technique::Points && pixels)
  {
    passes.squares = true;
    passes.squareSize = squareSizeOf(style.size.value);
    return passes;
  }
  passes.firstRadius = shareOf(style);
  const bool twice =
    style.technique == Technique::Ewa || (style.technique == Technique::Splats && style.blended);
  switch (style.technique)
  {
    case Technique::Spheres:
      passes.first.shape = SplatShape::Sphere;
      break;
    case Technique::Splats:
    case Technique::Ewa:
      passes.first = hasNormals ? ellipsePass(style.accuracy) : discPass(0.0f);
      passes.first.paraboloid =
        hasNormals ? (twice ? 0.0f : 1.0f) : (twice ? blendedParaboloid : opaqueParaboloid);
      break;
    case Technique::Silhouettes:
      passes.first = hasNormals ? ellipsePass(style.accuracy) : discPass(0.0f);
      passes.first.paraboloid = hasNormals ? 1.0f : innerParaboloid;
      addRim(passes);
      break;
    case Technique::Solid:
      passes.first = hasNormals ? ellipsePass(style.accuracy) : discPass(0.0f);
      passes.first.paraboloid = hasNormals ? 1.0f : solidParaboloid;
      break;
    default: // flat discs
      passes.first = discPass(0.0f);
      break;
  }
  boundRadius(style, conditions, passes.firstRadius, passes.first);
  if (twice)
  {
    blend(passes, hasNormals ? 1.0f : 2.0f);
  }
  return passes;
}

TechniquePasses wallPassesOf(const ResolvedStyle& style, const PassConditions& conditions)
{
  TechniquePasses passes;
  passes.firstRadius = shareOf(style);
  passes.first.shape = SplatShape::Wall;
  passes.first.paraboloid = conditions.hasNormals ? 1.0f : solidParaboloid;
  passes.first.leastRadius = leastDisc;
  boundRadius(style, conditions, passes.firstRadius, passes.first);
  return passes;
}

bool operator==(const TechniquePasses& a, const TechniquePasses& b)
{
  const auto same = [](const SplatPass& x, const SplatPass& y)
  {
    return x.shape == y.shape && x.paraboloid == y.paraboloid && x.leastRadius == y.leastRadius &&
      x.mostRadius == y.mostRadius && x.lowPass == y.lowPass && x.slackRadii == y.slackRadii &&
      x.slackPixels == y.slackPixels && x.rimFrom == y.rimFrom && x.rimRadii == y.rimRadii;
  };
  return a.squares == b.squares && a.squareSize == b.squareSize && same(a.first, b.first) &&
    a.firstRadius == b.firstRadius && a.blended == b.blended && same(a.second, b.second) &&
    a.secondRadius == b.secondRadius;
}

} // namespace pointfront
