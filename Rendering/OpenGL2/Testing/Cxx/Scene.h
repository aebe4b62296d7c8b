#pragma once

#include "BuiltStore.h"
#include "OpenGLFunctions.h"
#include "TestBuildClouds.h"

#include "pointfront/Residency/Residency.h"
#include "vtkOpenGLPointFrontMapper.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace pointfront::test
{

/// The values of a made-up point beside its position.
struct Sample
{
  GridPosition position{ 0 }; ///< millimetres from the grid's offset
  std::array<std::uint8_t, 3> rgb{ 255, 255, 255 };
  std::uint8_t classification = 0;
  double time = 0.0;
};

/// A store of `count` samples, built where the test may write. Node capacity 2000 points.
inline std::string storeOf(const std::string& name, std::size_t count,
  const std::function<Sample(std::size_t)>& sample, const glm::dvec3& offset = glm::dvec3(0.0),
  Layering layering = Layering::None)
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt8, 3 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  schema.add({ "gps_time", ScalarType::Float64, 1 });
  const QuantisationGrid grid = millimetres(offset);
  auto cloud = std::make_unique<CloudSource>(name, schema, grid);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Sample point = sample(i);
    cloud->addPosition(grid.toWorld(point.position));
    cloud->addValue(0, point.rgb);
    cloud->addValue(1, point.classification);
    cloud->addValue(2, point.time);
  }
  BuildOptions options = nodesOf(2000);
  options.layering = layering;
  return builtStore(name, std::move(cloud), options);
}

/// A square plane z = 0 of side * side points, `step` millimetres apart, centred on the origin;
/// white, classification 1 left and 2 right of x = 0, time = x in metres.
inline std::string planeStore(
  const std::string& name, int side, int step, const glm::dvec3& offset = glm::dvec3(0.0))
{
  return storeOf(
    name, static_cast<std::size_t>(side) * side,
    [=](std::size_t i)
    {
      const auto column = static_cast<int>(i) % side;
      const auto row = static_cast<int>(i) / side;
      Sample sample;
      sample.position = { (2 * column - side + 1) * step / 2, (2 * row - side + 1) * step / 2, 0 };
      sample.classification = sample.position.x < 0 ? 1 : 2;
      sample.time = 1e-3 * static_cast<double>(sample.position.x);
      return sample;
    },
    offset);
}

/// Bytes of a picture, bottom row first.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;

  std::array<int, 3> at(int x, int y) const
  {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * width + x);
    return { rgb[i], rgb[i + 1], rgb[i + 2] };
  }
  int lit() const
  {
    int count = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
    {
      count += rgb[i] + rgb[i + 1] + rgb[i + 2] > 0 ? 1 : 0;
    }
    return count;
  }
};

/// Pixels with a channel that differs by more than `tolerance`.
inline int differing(const Picture& a, const Picture& b, int tolerance = 0)
{
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
  {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      most = std::max(most, std::abs(int(a.rgb[i + c]) - int(b.rgb[i + c])));
    }
    count += most > tolerance ? 1 : 0;
  }
  return count;
}

/// Buffers, textures, vertex arrays and framebuffers of a window; it is current afterwards.
inline int liveNames(vtkRenderWindow* window)
{
  window->MakeCurrent();
  int count = 0;
  for (GLuint name = 1; name < 4096; ++name)
  {
    count += glIsBuffer(name) == GL_TRUE ? 1 : 0;
    count += glIsTexture(name) == GL_TRUE ? 1 : 0;
    count += glIsVertexArray(name) == GL_TRUE ? 1 : 0;
    count += glIsFramebuffer(name) == GL_TRUE ? 1 : 0;
  }
  return count;
}

/// A store in an offscreen window, seen from above (+z) over the origin of its grid.
struct Scene
{
  vtkNew<vtkPointFrontReader> reader;
  vtkSmartPointer<vtkPointFrontMapper> mapper = vtkSmartPointer<vtkPointFrontMapper>::New();
  vtkNew<vtkActor> actor;
  vtkNew<vtkRenderer> renderer;
  vtkSmartPointer<vtkRenderWindow> window = vtkSmartPointer<vtkRenderWindow>::New();

  explicit Scene(const std::string& store, const glm::dvec3& origin = glm::dvec3(0.0))
  {
    reader->SetFileName(store.c_str());
    mapper->SetInputConnection(reader->GetOutputPort());
    mapper->SetBackendToOpenGL();
    mapper->CompleteOn();
    mapper->SetTargetError(0.05);
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(300, 200);
    window->AddRenderer(renderer);
    lookFrom(origin + glm::dvec3(0.0, 0.0, 10.0), origin);
  }

  void lookFrom(const glm::dvec3& eye, const glm::dvec3& focus)
  {
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(eye.x, eye.y, eye.z);
    camera->SetFocalPoint(focus.x, focus.y, focus.z);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(30.0);
    camera->SetClippingRange(0.5, 50.0);
  }

  /// Draws and reads back; fails the test on any GL error.
  Picture draw()
  {
    window->Render();
    return read();
  }
  Picture read()
  {
    Picture picture;
    picture.width = window->GetSize()[0];
    picture.height = window->GetSize()[1];
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, picture.width - 1, picture.height - 1, 0, pixels);
    picture.rgb.assign(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return picture;
  }

  /// A picture of several windows' size, which VTK makes of tiles.
  Picture poster(int across, int down)
  {
    vtkNew<vtkWindowToImageFilter> filter;
    filter->SetInput(window);
    filter->SetScale(across, down);
    filter->ReadFrontBufferOff();
    filter->Update();
    vtkImageData* const image = filter->GetOutput();
    Picture picture;
    picture.width = image->GetDimensions()[0];
    picture.height = image->GetDimensions()[1];
    const auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
    picture.rgb.assign(bytes, bytes + 3 * std::size_t(picture.width) * picture.height);
    return picture;
  }

  /// Where a world point falls, in pixels from the lower left.
  std::array<double, 3> project(const glm::dvec3& world)
  {
    renderer->SetWorldPoint(world.x, world.y, world.z, 1.0);
    renderer->WorldToDisplay();
    const double* p = renderer->GetDisplayPoint();
    return { p[0], p[1], p[2] };
  }

  /// The same points in memory, drawn by VTK's own mapper with this scene's actor.
  vtkSmartPointer<vtkPolyDataMapper> inMemory()
  {
    vtkNew<vtkPointFrontReader> all;
    all->SetFileName(reader->GetFileName());
    all->SetOverviewPoints(100000000);
    all->Update();
    auto plain = vtkSmartPointer<vtkPolyDataMapper>::New();
    plain->SetInputData(all->GetOutput());
    return plain;
  }
};

/// Points and triangles that a frame hands to GL.
inline int primitivesOf(Scene& scene)
{
  scene.window->MakeCurrent();
  GLuint query = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  scene.window->Render();
  glEndQuery(GL_PRIMITIVES_GENERATED);
  GLuint count = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
  glDeleteQueries(1, &query);
  return static_cast<int>(count);
}

/// Counts what `of` reports from now on; `count` outlives it.
inline void countEvents(vtkObject* of, unsigned long event, int& count)
{
  vtkNew<vtkCallbackCommand> counting;
  counting->SetClientData(&count);
  counting->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  of->AddObserver(event, counting);
}

} // namespace pointfront::test
