#include "TechniquePasses.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

// Against ground truth (docs/adr/0016):
constexpr float visibleShare = 0.85f;   ///< of the closing radius, for what decides who is seen
constexpr float blendedShare = 1.25f;   ///< for what is blended
constexpr float leastDisc = 0.71f;      ///< pixels: reaches a pixel's centre wherever it lies
constexpr float leastEllipse = 0.5f;    ///< its low-pass and its centre's pixel do the rest
constexpr float leastBlended = 1.0f;
constexpr float lowPassPixels = 0.5f;
constexpr float opaqueParaboloid = 8.0f; ///< radii at the rim
constexpr float blendedParaboloid = 4.0f;
constexpr float slackPixels = 2.0f;
/// What closes an evenly thinned surface, in spacings: half of the inner nodes of Autzen and of
/// generated ground say less, 1.52 is the middle of ahn3_261k.
constexpr float thinnedSpacings = 1.4f;
constexpr int mostSquare = 255;
/// What closes a surface is drawn no larger than that, of the viewport's height: nearer to the eye
/// there is no surface to be seen.
constexpr float mostOfHeight = 0.125f;

SplatPass ellipsePass(SplatAccuracy accuracy)
{
  SplatPass pass;
  pass.shape =
    accuracy == SplatAccuracy::Affine ? SplatShape::Ellipse : SplatShape::ExactEllipse;
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

} // namespace

TechniquePasses passesOf(const ResolvedStyle& style, const PassDemand& demand)
{
  const bool hasNormals = demand.hasNormals;
  TechniquePasses passes;
  const bool pixels = style.size.mode == SplatSize::Mode::Pixels;
  const bool spacing = style.size.mode == SplatSize::Mode::Spacing;
  if (style.technique == Technique::Points && pixels)
  {
    passes.squares = true;
    passes.squareSize =
      std::clamp(static_cast<int>(std::lround(style.size.value)), 1, mostSquare);
    return passes;
  }
  passes.firstRadius = spacing ? visibleShare : 1.0f;
  const bool twice = style.technique == Technique::Ewa ||
    (style.technique == Technique::Splats && style.blended);
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
    default: // flat discs
      passes.first = discPass(0.0f);
      break;
  }
  if (spacing)
  {
    const float closing =
      visibleShare * demand.spacingPx * static_cast<float>(std::max(style.size.value, 0.0)) *
      (demand.thinned ? thinnedSpacings : 1.0f);
    passes.first.leastRadius = std::max(passes.first.leastRadius, closing);
    passes.first.mostRadius =
      std::max(passes.first.leastRadius, mostOfHeight * static_cast<float>(demand.heightPx));
  }
  if (twice)
  {
    blend(passes, hasNormals ? 1.0f : 2.0f);
  }
  return passes;
}

bool operator==(const TechniquePasses& a, const TechniquePasses& b)
{
  const auto same = [](const SplatPass& x, const SplatPass& y)
  {
    return x.shape == y.shape && x.paraboloid == y.paraboloid &&
      x.leastRadius == y.leastRadius && x.mostRadius == y.mostRadius && x.lowPass == y.lowPass &&
      x.slackRadii == y.slackRadii && x.slackPixels == y.slackPixels;
  };
  return a.squares == b.squares && a.squareSize == b.squareSize && same(a.first, b.first) &&
    a.firstRadius == b.firstRadius && a.blended == b.blended && same(a.second, b.second) &&
    a.secondRadius == b.secondRadius;
}

} // namespace pointfront
