#pragma once

#include "Camera.h"
#include "KeyTable.h"

#include "pointfront/Base/Bounds.h"

#include <glm/vec2.hpp>

#include <optional>

class vtkRenderer;

namespace pointfront
{

class MappedStores;

/// The camera of the window. It is kept as the tool's files have it, so that a picture by
/// `render --camera` is what the window shows.
class ViewCamera
{
public:
  ViewCamera(vtkRenderer* renderer, const MappedStores& stores);

  const Camera& camera() const { return camera_; }
  void set(const Camera& camera);
  /// The whole of the stores.
  void showAll(ViewDirection direction);
  /// The stores may lie elsewhere than before: shows all if that is what was shown, else holds the
  /// camera.
  void follow();

  /// Looks as the key asks; false if the key is for something else. `home`: of ShowAll.
  bool obey(KeyAction action, ViewDirection home);

  /// Pixels of the view.
  glm::ivec2 size() const;
  /// World position of what is drawn at the pixel, or next to it within some pixels; nothing where
  /// there is background.
  std::optional<glm::dvec3> surfaceAt(const glm::ivec2& pixel) const;
  /// The same, or where the pixel's ray is as far away as the focal point.
  glm::dvec3 anchorAt(const glm::ivec2& pixel) const;
  /// Brings the eye nearer to a point by that factor, or away from it; not so near that the point
  /// would leave the view in front of the clipping plane.
  void zoom(const glm::dvec3& anchor, double factor);

private:
  vtkRenderer* renderer_; // the renderer of the window that has this object
  const MappedStores& stores_;
  Camera camera_;
  std::optional<ViewDirection> all_; ///< the camera shows all from there
};

} // namespace pointfront
