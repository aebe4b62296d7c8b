#pragma once

#include "Scene.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>

#include <cmath>
#include <string>
#include <vector>

namespace pointfront::test
{

/// A wavy sheet of 200 * 200 points, 20 mm apart, whose colours say where they are.
inline std::string sheetStore()
{
  return storeOf("sheet", 200 * 200,
    [](std::size_t i)
    {
      const int column = static_cast<int>(i % 200);
      const int row = static_cast<int>(i / 200);
      Sample sample;
      const double height = 300.0 * std::sin(0.07 * column) * std::cos(0.05 * row);
      sample.position = { 20 * column - 1990, 20 * row - 1990, static_cast<int>(height) };
      sample.rgb = { static_cast<std::uint8_t>(55 + column), static_cast<std::uint8_t>(55 + row),
        static_cast<std::uint8_t>(150 + height / 3) };
      sample.classification = static_cast<std::uint8_t>(1 + column / 100);
      sample.time = 1e-3 * height;
      return sample;
    });
}

struct Sheet : Scene
{
  Sheet()
    : Scene(sheetStore())
  {
    lookFrom({ 3.0, -6.0, 4.0 }, { 0.0, 0.0, 0.0 });
  }
  Picture with(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
  /// Both back ends draw alike. llvmpipe puts points on steps of 1/256 px, which moves one in a
  /// hundred by a pixel; and where neighbours have the same depth but for rounding either may win:
  /// their colours differ by `twoColumns` at most.
  static constexpr int twoColumns = 12;
  void expectAlike(const char* what, double share = 0.01)
  {
    const Picture gl = with(vtkPointFrontMapper::OPENGL);
    const Picture software = with(vtkPointFrontMapper::SOFTWARE);
    EXPECT_GT(gl.lit(), 2000) << what;
    EXPECT_NEAR(gl.lit(), software.lit(), share * gl.lit()) << what;
    EXPECT_LE(differing(gl, software, twoColumns), share * gl.lit()) << what;
  }
  vtkSmartPointer<vtkActor> addPyramid(const glm::dvec3& centre, double height)
  {
    vtkNew<vtkPoints> points;
    for (const glm::dvec2& corner :
      { glm::dvec2(-0.8, -0.8), { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } })
    {
      points->InsertNextPoint(centre.x + corner.x, centre.y + corner.y, centre.z - 0.5 * height);
    }
    points->InsertNextPoint(centre.x, centre.y, centre.z + 0.5 * height);
    vtkNew<vtkCellArray> sides;
    for (vtkIdType side = 0; side < 4; ++side)
    {
      sides->InsertNextCell({ side, (side + 1) % 4, 4 });
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(sides);
    vtkNew<vtkPolyDataMapper> surfaceMapper;
    surfaceMapper->SetInputData(surface);
    auto pyramid = vtkSmartPointer<vtkActor>::New();
    pyramid->SetMapper(surfaceMapper);
    pyramid->GetProperty()->SetColor(0.2, 0.9, 0.3);
    renderer->AddActor(pyramid);
    return pyramid;
  }
  std::vector<float> depths()
  {
    vtkNew<vtkFloatArray> z;
    const int* size = window->GetSize();
    window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, z);
    return std::vector<float>(z->GetPointer(0), z->GetPointer(0) + z->GetNumberOfValues());
  }
};

} // namespace pointfront::test
