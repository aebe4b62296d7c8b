#pragma once

#include "pointfront/Style/FrameShading.h"

#include <vtkNew.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace pointfront
{

/// A picture of points on the GPU.
struct SplatTextures
{
  vtkTextureObject* colours = nullptr;
  vtkTextureObject* depths = nullptr; ///< r: from the eye's plane; g: highlight
  vtkTextureObject* ids = nullptr; ///< in selections
};

/// Composes the pictures of the parts of a plan: the twin of SoftwareComposition.
/// Bytes    12 a pixel for each of three pictures, with ids 8 more.
/// Threads  that of the GL context, which is current in all functions but the constructor.
class SplatComposition
{
public:
  /// Most translucent groups outside of lenses, and in each lens.
  static constexpr std::size_t mostGroups = 4;

  struct Group
  {
    SplatTextures picture;
    double opacity;
  };

  SplatComposition();
  ~SplatComposition();

  /// Sets the size of the pictures. False if GL has no room.
  bool begin(vtkOpenGLRenderWindow* window, int width, int height, bool ids);

  // Each draws over the whole viewport, into one of three pictures: not into one that it reads.
  // Translucent groups over what is opaque. `untouched`: a picture that is needed later.
  SplatTextures blend(const SplatTextures& base, const std::vector<Group>& groups,
    const SplatTextures& untouched = {});
  /// `inside`: without colours where nothing is shown; `around`: depths of what a lens around a
  /// class is made by.
  SplatTextures putLens(const SplatTextures& base, const SplatTextures& inside,
    const FrameLens& lens, vtkTextureObject* around);
  SplatTextures highlight(const SplatTextures& base, const std::vector<FrameHighlight>& highlights);

  void release(vtkOpenGLRenderWindow* window);

private:
  struct Target
  {
    vtkNew<vtkTextureObject> colours;
    vtkNew<vtkTextureObject> depths;
    vtkNew<vtkTextureObject> ids;
    vtkNew<vtkOpenGLFramebufferObject> framebuffer;
  };
  struct Input
  {
    const char* name;
    vtkTextureObject* texture;
  };

  /// Draws with the textures, and gives what it drew into.
  template <typename SetUniforms>
  SplatTextures draw(const std::string& fragment, std::vector<Input> inputs,
    const SplatTextures& base, const SetUniforms& setUniforms);
  Target& next(const std::vector<Input>& inputs);
  /// `mark`: of the pixels that it is around.
  SplatTextures drawRim(const SplatTextures& base, const FrameHighlight& look, int mark);

  vtkOpenGLRenderWindow* window_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  bool ids_ = false;
  std::array<Target, 3> targets_;
  vtkNew<vtkTextureObject> mask_;
  std::shared_ptr<const LensMask> loadedMask_;
};

} // namespace pointfront
