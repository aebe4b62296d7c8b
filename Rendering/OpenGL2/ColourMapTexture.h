#pragma once

#include "pointfront/Style/ColourMap.h"
#include "pointfront/Style/PointColouring.h"

#include <vtkNew.h>

#include <memory>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace pointfront
{

/// A colour map as a texture; see glsl/ColourMapTexture.glsl. A new map remakes the texture and
/// touches no point, unless PointColouring::fitTo() makes other floats of their values.
/// Threads  that of the GL context, current in all functions but the constructor.
class ColourMapTexture
{
public:
  ColourMapTexture();
  ~ColourMapTexture();

  void update(vtkOpenGLRenderWindow* window, std::shared_ptr<const ColourMap> map);
  /// The map of the texture.
  const std::shared_ptr<const ColourMap>& map() const { return map_; }
  /// `referenceZ` is the store's z of the frame's reference point (elevations are relative to it),
  /// `stepZ` a step of the store's grid.
  void activate(
    vtkShaderProgram* program, const PointColouring& colouring, double referenceZ, double stepZ);
  void deactivate();
  void release(vtkWindow* window);

private:
  vtkNew<vtkTextureObject> texture_;
  std::shared_ptr<const ColourMap> map_;
};

} // namespace pointfront
