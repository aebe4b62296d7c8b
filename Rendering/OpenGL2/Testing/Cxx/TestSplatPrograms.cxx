// Each program of splats compiles and links by itself: no picture needs to be asked for first.

#include "Scene.h"
#include "SplatLights.h"
#include "SplatProgram.h"

#include <vtkOpenGLShaderCache.h>
#include <vtkShaderProgram.h>

#include <set>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

using Kind = PointColouring::Kind;

const std::vector<bool> bothWays{ false, true };

/// Shapes, projections, passes and outputs: what lines of the set-up and of the pixels depend on.
std::set<SplatVariant> shapes()
{
  std::set<SplatVariant> all;
  for (int shape = 0; shape < 5; ++shape)
  {
    for (int bits = 0; bits < 64; ++bits)
    {
      SplatVariant one;
      one.square = shape == 0;
      one.shape = static_cast<SplatShape>(shape == 0 ? 0 : shape - 1);
      one.parallel = (bits & 1) != 0;
      one.quads = (bits & 2) != 0;
      one.second = (bits & 4) != 0;
      one.lit = (bits & 8) != 0 && !one.second;
      one.ids = (bits & 16) != 0 && !one.second;
      one.follows = (bits & 32) != 0 && one.ids;
      one.shaped = true;
      one.normals = shape > 1;
      all.insert(one);
    }
  }
  return all;
}

/// Colours, normals and radii: what lines of the vertices depend on.
std::set<SplatVariant> attributes()
{
  std::set<SplatVariant> all;
  for (int colour = 0; colour < 5; ++colour)
  {
    for (int radius = 0; radius < 5; ++radius)
    {
      for (int bits = 0; bits < 16; ++bits)
      {
        SplatVariant one;
        one.shape = SplatShape::Ellipse;
        one.marked = colour == 4;
        one.colour = one.marked ? Kind::Direct : static_cast<Kind>(colour);
        one.radius = static_cast<RadiusSource>(radius);
        one.parallel = (bits & 1) != 0;
        one.second = (bits & 2) != 0;
        one.shaped = (bits & 4) != 0 || one.radius == RadiusSource::Codes;
        one.normals = (bits & 8) != 0 && one.shaped;
        all.insert(one);
      }
    }
  }
  return all;
}

} // namespace

TEST(SplatPrograms, EachOneCompiles)
{
  vtkNew<vtkRenderer> renderer;
  const auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetSize(20, 20);
  window->AddRenderer(renderer);
  window->Render();
  auto* const gl = vtkOpenGLRenderWindow::SafeDownCast(window);
  ASSERT_NE(gl, nullptr);
  SplatPrograms programs;
  std::set<vtkShaderProgram*> distinct;
  std::set<SplatVariant> variants = shapes();
  const std::set<SplatVariant> others = attributes();
  variants.insert(others.begin(), others.end());
  for (const SplatVariant& variant : variants)
  {
    vtkShaderProgram* const program = programs.use(gl, variant);
    ASSERT_NE(program, nullptr) << "shape " << static_cast<int>(variant.shape) << ", colour "
                                << static_cast<int>(variant.colour) << ", radius "
                                << static_cast<int>(variant.radius);
    EXPECT_TRUE(program->GetCompiled());
    distinct.insert(program);
  }
  EXPECT_EQ(distinct.size(), variants.size());
  for (const bool blended : bothWays)
  {
    for (const bool lit : bothWays)
    {
      for (const bool eyeDome : bothWays)
      {
        for (const int looks : { 1, static_cast<int>(mostLooks) })
        {
          EXPECT_NE(programs.useResolve(gl, { blended, lit, eyeDome, looks }), nullptr);
        }
      }
    }
  }
  gl->GetShaderCache()->ReleaseCurrentShader();
}
