#pragma once

#include "Distance.h"
#include "WorldMarks.h"

#include "pointfront/Base/Result.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>

class vtkRenderer;

namespace pointfront
{

class MappedStores;

/// Points that the user asks about: one at a time, or two and what lies between them. They are
/// marked in the picture.
/// Output  each answer is a line of JSON on stdout.
class Inspection
{
public:
  Inspection(vtkRenderer* renderer, const MappedStores& stores);

  /// The point at the pixel; the text tells all that the store holds of it.
  /// Errors  those of pointAt().
  Result<std::string> pick(const glm::ivec2& pixel);
  /// The point at the pixel is one end; after the second one the text tells the distance.
  Result<std::string> measure(const glm::ivec2& pixel);
  /// One end is there, and the other one is awaited.
  bool measuring() const { return from_.has_value(); }
  /// Nothing is marked.
  void clear();

private:
  vtkRenderer* renderer_;
  const MappedStores& stores_;
  WorldMarks marks_;
  std::optional<glm::dvec3> from_;
};

} // namespace pointfront
