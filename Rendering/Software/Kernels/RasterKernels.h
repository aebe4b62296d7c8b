#pragma once

#include "RasterBatch.h"

namespace pointfront
{

/// The shape of a splat, for the loops that draw it into the buffers.
enum class SplatShape : std::int32_t
{
  Disc, ///< faces the eye
  Ellipse, ///< affine image of a disc with a normal, depth by its plane (EWA-5)
  ExactEllipse, ///< ray and disc in each pixel
  Sphere, ///< ray and hemisphere in each pixel (LAYERS-5)
  Wall ///< upright rectangle that faces the eye, from the point down (LAYERS-7)
};

/// Constants of a pass over splats.
struct SplatPass
{
  SplatShape shape = SplatShape::Disc;
  /// Added to the depth: that many radii at the rim, falling with q to nothing at the centre. Of
  /// splats that overlap the one with the nearest centre wins (docs/adr/0016).
  float paraboloid = 0.0f;
  float leastRadius = 0.71f; ///< pixels; a disc of 0.71 reaches a pixel's centre wherever it lies
  float mostRadius = 1.0e5f; ///< pixels
  float lowPass = 0.0f; ///< ellipses: radius of a screen-space low-pass, pixels; 0: none
  float slackRadii = 1.0f; ///< second pass: adds up to that far behind the nearest, in radii
  float slackPixels = 2.0f; ///< and that many pixels' size at its depth
  /// Beyond that q a splat is its rim, drawn that many radii further back (LAYERS-6). Discs and
  /// ellipses of first passes alone.
  float rimFrom = 1.0f;
  float rimRadii = 0.0f;

  bool rimmed() const { return rimRadii > 0.0f; }
  /// q of an ellipse is at most that in the pixel that its centre lies in: no rim.
  float mostAtCentre() const { return 0.999f * rimFrom; }
};

/// Radii as codes of a byte (SplatRadius.h), and the radii that they stand for.
struct RadiusCodes
{
  const std::uint8_t* codes = nullptr; ///< codes from the batch's first point on
  const float* radii = nullptr; ///< 256; 0: not known
  float scale = 1.0f;
  float unknown = 0.0f; ///< taken where it is not known; all are after `scale`
  float least = 0.0f;
  float most = 0.0f;
};

/// Normals of three 16-bit numbers, and the matrix that turns them into camera space.
struct StoredNormals
{
  const std::int16_t* xyz = nullptr; ///< from the batch's first point on
  float matrix[3][3] = {}; ///< rows
};

/// The inner loops, made for one instruction set. All sets give the same bits: only operations that
/// IEEE 754 rounds exactly, no contraction.
struct RasterKernels
{
  const char* instructionSet;

  /// Fills screenX, screenY and depth.
  void (*project)(const RasterCamera&, const RasterPositions&, int count, RasterBatch&);
  /// Squares of `size` x `size` pixels, 1 to 255. `index` is that of the batch's first point.
  void (*drawSquares)(
    const RasterWindow&, RasterBatch&, int count, int size, std::uint32_t index, RasterKey* keys);
  /// Fills radius; normalX, normalY, normalZ. Walls have `height` for a normal.
  void (*loadRadii)(const RadiusCodes&, int count, RasterBatch&);
  void (*loadNormals)(const StoredNormals&, int count, RasterBatch&);
  /// Fills what the shape needs, from radius and normal, and sorts by extent.
  void (*setUp)(
    const RasterCamera&, const RasterWindow&, const SplatPass&, int count, RasterBatch&);
  /// Nearest depth and index into `keys`.
  void (*drawSplats)(const RasterCamera&, const RasterWindow&, const SplatPass&, RasterBatch&,
    int count, std::uint32_t index, RasterKey* keys);
  /// Adds weight * colour (r, g, b) and weight, four sums a pixel, where the splat is not behind
  /// the slack. `nearest` is the first pass's depth, infinite negative where nothing is.
  void (*addSplats)(const RasterCamera&, const RasterWindow&, const SplatPass&, RasterBatch&,
    int count, const float* nearest, std::uint32_t* sums);
};

/// The best that this processor can, unless POINTFRONT_INSTRUCTIONS is "portable" or "AVX2".
const RasterKernels& rasterKernels();

/// By name, for tests; null if this build or processor has it not.
const RasterKernels* rasterKernelsOf(const char* instructionSet);

} // namespace pointfront
