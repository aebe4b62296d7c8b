#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace pointfront
{

/// Pixels around a viewport that are drawn and not shown.
struct ViewportMargin
{
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  bool isNone() const { return left == 0 && bottom == 0 && right == 0 && top == 0; }
};

/// The camera of one frame in double, as back ends use it. The front's View says what is in sight;
/// this says where each point lands.
/// Spaces  store: the store's world coordinates. View: the eye at 0, looking along -z, x to the
///         right, y up, world units. Clip: as OpenGL, z in [-w, w].
/// Pixels  (0, 0) is the lower left corner of the viewport, pixel centres at + 0.5.
struct FrameCamera
{
  glm::dmat4 storeToView{ 1.0 }; ///< affine; an actor's matrix is part of it
  /// Any frustum, off-axis too. Clip x does not depend on y, nor y on x; a parallel view's on no z.
  glm::dmat4 viewToClip{ 1.0 };
  /// The reference point in store coordinates. Positions are taken relative to it before they
  /// become floats: the eye, in a parallel view the focal point (docs/adr/0004).
  glm::dvec3 reference{ 0.0 };
  /// The place of the reference point in view space: exactly 0 when it is the eye, so that no
  /// rounding noise of two large terms enters.
  glm::dvec3 referenceInView{ 0.0 };
  /// Takes what is in the view space of VTK's camera to this view's: an eye of a stereo pair stands
  /// aside, and a projection may shear or turn.
  glm::dmat4 cameraToView{ 1.0 };
  bool parallel = false;
  int width = 1; ///< width of the viewport and its margin, pixels
  int height = 1;
  ViewportMargin margin; ///< part of width, height and viewToClip; set by setViewport()
  int pictureHeight = 0; ///< pixels; of the picture of which the viewport is a tile; 0: it is all

  /// A symmetric view for tools and tests; `verticalAngle` in radians, square pixels.
  static FrameCamera perspective(const glm::dvec3& position, const glm::dvec3& focalPoint,
    const glm::dvec3& up, double verticalAngle, double nearDistance, double farDistance, int width,
    int height);
  /// The same without perspective; `halfHeight`: world units from the middle to the upper edge.
  static FrameCamera parallelView(const glm::dvec3& position, const glm::dvec3& focalPoint,
    const glm::dvec3& up, double halfHeight, double nearDistance, double farDistance, int width,
    int height);

  /// Draws for a viewport of that many pixels, and as many around it as the margin says.
  void setViewport(int viewportWidth, int viewportHeight, const ViewportMargin& around);

  glm::dmat4 storeToClip() const { return viewToClip * storeToView; }
  /// Lengths that depend on the height of a picture are the same in all of its tiles, pixels.
  int wholeHeight() const;
  /// Height of the whole picture from bottom to top, world units; for a parallel view.
  double wholeWorldHeight() const;
};

} // namespace pointfront
