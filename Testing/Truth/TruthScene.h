#pragma once

#include "TriangleMesh.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pointfront::truth
{

/// A perspective camera, as in the tool's camera files.
struct TruthCamera
{
  glm::dvec3 position{ 0.0 };
  glm::dvec3 focalPoint{ 0.0 };
  glm::dvec3 viewUp{ 0.0, 0.0, 1.0 };
  double viewAngleDegrees = 45.0; ///< vertical
};

struct TruthView
{
  std::string name; ///< far, mid, close, graze
  TruthCamera camera;
  /// Depths in this view differ so much that points are sampled as a level of detail would pick
  /// them: the spacing doubles with each doubling of depth.
  bool graded = false;
};

struct TruthScene
{
  std::string name;
  TriangleMesh mesh;
  std::vector<TruthView> views;

  const TruthView* view(const std::string& wanted) const; ///< nullptr: there is none
};

/// 200 x 200 m of sloped ground with roads, 49 plots with gabled houses and trees of loose leaves,
/// and four lines of poles with two wires each. Metres, z up, origin in the middle.
TruthScene makeTown();
/// A closed smooth surface without an edge: a bumpy tube around a trefoil knot, 10 units across.
TruthScene makeKnot();
/// "town" or "knot".
std::optional<TruthScene> makeScene(const std::string& name);

} // namespace pointfront::truth
