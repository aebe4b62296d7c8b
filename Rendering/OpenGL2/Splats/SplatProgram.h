#pragma once

#include "TechniquePasses.h"

#include "pointfront/Style/PointColouring.h"

#include <map>
#include <string>
#include <tuple>
#include <utility>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace pointfront
{

/// The source of a splat's radius (SplatData.glsl).
enum class RadiusSource : std::uint8_t
{
  Pixels,
  World,
  Node,
  Codes,
  Sizes
};

/// The variant of a program that draws splats.
struct SplatVariant
{
  bool square = false;
  SplatShape shape = SplatShape::Disc;
  bool parallel = false;
  bool second = false; ///< weights and colours of what is not behind
  PointColouring::Kind colour = PointColouring::Kind::Flat;
  bool marked = false;
  bool shaped = false;
  bool normals = false;
  RadiusSource radius = RadiusSource::Node;
  bool lit = false;
  bool ids = false;
  bool quads = false; ///< for splats that are larger than points can be
  bool kept = false; ///< points that were visible in an earlier picture
  bool standIn = false; ///< points of a refining view without ids
  bool follows = false; ///< only what is seen before what was drawn earlier

  auto key() const
  {
    return std::make_tuple(square, shape, parallel, second, colour, marked, shaped, normals, radius,
      lit, ids, quads, kept, standIn, follows);
  }
  friend bool operator<(const SplatVariant& a, const SplatVariant& b) { return a.key() < b.key(); }
};

/// Programs of splats in one context, each compiled when it is first asked for.
/// Threads  that of the GL context, which is current.
class SplatPrograms
{
public:
  /// Bound and ready for uniforms; null where GL does not compile it, which VTK tells.
  vtkShaderProgram* use(vtkOpenGLRenderWindow* window, const SplatVariant& variant);
  /// The same points, but these are looked for in the last picture, and written to a buffer.
  vtkShaderProgram* useCapture(vtkOpenGLRenderWindow* window, const SplatVariant& variant);
  /// Choices of the pass that makes a picture of the drawn sums.
  struct Resolve
  {
    bool blended = false;
    bool lit = false;
    bool eyeDome = false;
    int looks = 1;
  };
  vtkShaderProgram* useResolve(vtkOpenGLRenderWindow* window, const Resolve& variant);
  /// The pass that puts a layer, of stand-ins or of what grows, into what is seen.
  vtkShaderProgram* useLayer(vtkOpenGLRenderWindow* window, bool standIns, bool parallel, bool lit);
  /// The pass that empties sums where something came that is much nearer.
  vtkShaderProgram* useForget(vtkOpenGLRenderWindow* window, bool parallel);

private:
  struct Sources
  {
    std::string vertex;
    std::string fragment;
    std::string geometry;
  };
  const Sources& sourcesOf(const SplatVariant& variant, bool captures);

  std::map<std::pair<SplatVariant, bool>, Sources> sources_;
};

} // namespace pointfront
