#pragma once

#include "PixelRectangle.h"
#include "SplatTarget.h"

#include "pointfront/Plan/FramePlan.h"

#include <vtkNew.h>

#include <array>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkTextureObject;

namespace pointfront
{

/// Fills the holes of what splats show, on the GPU: the twin of fillHoles().
/// Bytes    40 a pixel, while pictures are filled; with several looks 60.
/// Threads  that of the GL context, which is current in all functions but the constructor.
class SplatHoleFiller
{
public:
  SplatHoleFiller();
  ~SplatHoleFiller();

  /// Fills the pixels of `place` of what is seen, which stays as it is; nothing is seen beside it.
  /// False if GL has no room. `parts`: what there is of it.
  bool fill(vtkOpenGLRenderWindow* window, const SeenTextures& seen, vtkTextureObject* sums,
    const SplatTarget::Parts& parts, const FramePlan& plan, const PixelRectangle& place);
  /// Colours of the last filling, in place of SplatTarget's: sums and light are part of them.
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
  static constexpr int levels = 3; ///< levels of HoleFiller.cxx

  bool prepare(vtkOpenGLRenderWindow* window, int width, int height, bool looks);
  void clear(vtkOpenGLState* state);
  static bool allocate(
    vtkOpenGLRenderWindow* window, Level& level, int width, int height, bool looks);

  std::array<Level, levels + 1> gathered_; ///< the way down
  std::array<Level, levels> filled_; ///< the way up
  bool looks_ = false; ///< depths have one
};

} // namespace pointfront
