#pragma once

#include "PixelRectangle.h"

#include "pointfront/Plan/FrameCamera.h"

#include <vtkNew.h>

#include <array>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace pointfront
{

class SplatTarget;

/// Fills the holes of what splats show, on the GPU: the twin of fillHoles().
/// Bytes    40 a pixel, while pictures are filled.
/// Threads  that of the GL context, which is current in all functions but the constructor.
class SplatHoleFiller
{
public:
  SplatHoleFiller();
  ~SplatHoleFiller();

  /// Fills the pixels of `place` (pixels beside it may change) of what is seen in the target, whose
  /// framebuffers stay as they are. False if GL has no room. `blended`: the target has sums.
  bool fill(vtkOpenGLRenderWindow* window, SplatTarget& target, bool blended,
    const FrameCamera& camera, const PixelRectangle& place);
  /// Of the last filling, in place of SplatTarget's: sums are part of the colours.
  vtkTextureObject* seenColours() { return filled_[0].colours; }
  vtkTextureObject* seenDepths() { return filled_[0].depths; }

  void release(vtkOpenGLRenderWindow* window);

private:
  struct Level
  {
    vtkNew<vtkTextureObject> colours;
    vtkNew<vtkTextureObject> depths;
    vtkNew<vtkOpenGLFramebufferObject> framebuffer;
    int width = 0;
    int height = 0;
  };
  static constexpr int levels = 3; ///< of HoleFiller.cxx

  bool prepare(vtkOpenGLRenderWindow* window, int width, int height);
  static bool allocate(vtkOpenGLRenderWindow* window, Level& level, int width, int height);

  std::array<Level, levels + 1> gathered_; ///< the way down
  std::array<Level, levels> filled_; ///< the way up
};

} // namespace pointfront
