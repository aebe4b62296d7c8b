#pragma once

#include "PixelRectangle.h"

#include <vtkNew.h>

#include <cstdint>
#include <memory>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace pointfront
{

/// Who is seen in each pixel.
struct SeenTextures
{
  vtkTextureObject* colours = nullptr;
  vtkTextureObject* depths = nullptr; ///< as SplatTarget::seenDepths()
  vtkTextureObject* normals = nullptr; ///< without textures where nothing is lit
};

/// The textures that splats are drawn into, and the picture that is made of them.
/// Bytes    16 a pixel for who is seen; with several looks 8, with light 16, with ids 8, with
///          blending 16 more; 12 where points follow others, with blending 4 more while it is
///          refined; 12 for the picture.
/// Threads  that of the GL context, which is current in all functions but the constructor.
class SplatTarget
{
public:
  /// The textures that a frame needs.
  struct Parts
  {
    int width = 1;
    int height = 1;
    bool lit = false;
    bool ids = false;
    bool blended = false;
    bool looks = false; ///< several
    bool picture = true; ///< that is made of who is seen
  };

  SplatTarget();
  ~SplatTarget();

  /// Makes the textures that are missing or of another size, and gives back what is not needed.
  /// False where GL has no room for them or cannot draw into them.
  bool prepare(vtkOpenGLRenderWindow* window, const Parts& parts);
  /// Whether all textures that a frame needs exist.
  bool has(const Parts& parts) const;
  /// Who drew into it last; null: nobody since it was made.
  const void* owner() const { return owner_; }
  void setOwner(const void* owner) { owner_ = owner; }
  void release(vtkOpenGLRenderWindow* window);

  // Framebuffers: bound and empty. The window's state is the caller's to restore.
  void beginSeen(bool empty); ///< false: with what is there
  void beginSums(bool empty); ///< likewise
  void beginPicture();
  /// The depths that decide go into lastDepths().
  void keepDepths(vtkOpenGLRenderWindow* window);
  /// Binds for points that follow others: who is seen in a rectangle goes into earlierDepths() and
  /// earlierIds(), with which points are compared; the depth buffer becomes empty there.
  void follow(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle);
  /// The sums of another target of the same size become those of this one.
  void takeSums(SplatTarget& other);

  SeenTextures seen() { return { seenColours_, seenDepths_, normals_ }; }
  /// r: the depth that decided, g: that of the splat; camera units. b: its look, where there are
  /// several; a: the number of its node, of stand-ins.
  vtkTextureObject* seenDepths() { return seenDepths_; }
  vtkTextureObject* ids() { return ids_; }
  vtkTextureObject* sums() { return sums_; }
  vtkTextureObject* lastDepths() { return lastDepths_; }
  vtkTextureObject* earlierDepths() { return earlierDepths_; }
  vtkTextureObject* earlierIds() { return earlierIds_; }
  vtkTextureObject* pictureColour() { return pictureColour_; }
  /// r: depth, g: highlight.
  vtkTextureObject* pictureDepth() { return pictureDepth_; }

private:
  bool attach(vtkOpenGLRenderWindow* window);

  Parts parts_;
  const void* owner_ = nullptr;
  bool ready_ = false;
  vtkNew<vtkTextureObject> seenColours_;
  vtkNew<vtkTextureObject> seenDepths_;
  vtkNew<vtkTextureObject> depthBuffer_;
  vtkNew<vtkTextureObject> normals_;
  vtkNew<vtkTextureObject> ids_;
  vtkNew<vtkTextureObject> sums_;
  vtkNew<vtkTextureObject> lastDepths_;
  vtkNew<vtkTextureObject> earlierDepths_;
  vtkNew<vtkTextureObject> earlierIds_;
  vtkNew<vtkTextureObject> pictureColour_;
  vtkNew<vtkTextureObject> pictureDepth_;
  vtkNew<vtkOpenGLFramebufferObject> seen_;
  vtkNew<vtkOpenGLFramebufferObject> summed_;
  vtkNew<vtkOpenGLFramebufferObject> picture_;
};

/// The targets of a window's clouds: each has one of its own and goes on from its own last picture,
/// up to a number of pixels; the others draw into one in turn.
/// Threads  as SplatTarget.
class SplatTargets
{
public:
  /// For a viewport of so many pixels. `owner` holds it as long as it draws.
  std::shared_ptr<SplatTarget> of(const void* owner, std::int64_t pixels);

private:
  struct Own
  {
    const void* owner;
    std::int64_t pixels;
    std::weak_ptr<SplatTarget> target;
  };
  std::vector<Own> own_;
  std::weak_ptr<SplatTarget> shared_;
};

} // namespace pointfront
