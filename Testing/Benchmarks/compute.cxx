// usage: pointfrontComputeBenchmark STORE.pfront [ROUNDS [POINTS]]
//
// Milliseconds for a picture of the first POINTS points of a cloud, 1280 x 720, as points of one
// pixel and as blended discs, by
//   raster    GL_POINTS into a framebuffer: one pass, or depths and then sums,
//   compute   compute shaders (OpenGL 4.3) on the same buffer: 32-bit atomics on depths, then on
//             colours or sums, and a pass over the picture,
//   opengl    vtkPointFrontMapper, all points, its OpenGL back end,
//   software  the same, its software back end.
// The four take turns while the camera goes around the cloud. raster and compute hold nothing but
// 16 bytes a point: they bound what a back end of their kind could reach. JSON on stdout.

#include "BenchmarkCloud.h"
#include "RawScene.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"
#include "vtkPointFrontStyle.h"

#include <nlohmann/json.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace pointfront;
using namespace compute_benchmark;

struct Cloud
{
  std::vector<PackedPoint> points;
  std::array<double, 3> centre;
  double spacing; ///< metres: as if the points filled their box seen from above
};

Cloud packed(vtkPolyData* data, vtkIdType most)
{
  Cloud cloud;
  double bounds[6];
  data->GetBounds(bounds);
  const vtkIdType count = std::min(most, data->GetNumberOfPoints());
  auto* const colours = vtkUnsignedCharArray::SafeDownCast(data->GetPointData()->GetScalars());
  for (int axis = 0; axis < 3; ++axis)
  {
    cloud.centre[static_cast<std::size_t>(axis)] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
  }
  cloud.points.resize(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    PackedPoint& point = cloud.points[static_cast<std::size_t>(i)];
    const double* const p = data->GetPoint(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point.position[axis] = static_cast<float>(p[axis] - cloud.centre[axis]);
      point.colour[axis] = colours->GetValue(3 * i + static_cast<vtkIdType>(axis));
    }
    point.colour[3] = 255;
  }
  cloud.spacing =
    std::sqrt((bounds[1] - bounds[0]) * (bounds[3] - bounds[2]) / static_cast<double>(count));
  return cloud;
}

/// From coordinates relative to the centre to clip space, by rows.
std::array<float, 16> clipMatrix(vtkRenderer* renderer, const std::array<double, 3>& centre)
{
  vtkMatrix4x4* const matrix = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    static_cast<double>(width) / height, -1.0, 1.0);
  std::array<float, 16> result;
  for (int row = 0; row < 4; ++row)
  {
    double moved = matrix->GetElement(row, 3);
    for (int column = 0; column < 3; ++column)
    {
      const double element = matrix->GetElement(row, column);
      moved += element * centre[static_cast<std::size_t>(column)];
      result[static_cast<std::size_t>(4 * row + column)] = static_cast<float>(element);
    }
    result[static_cast<std::size_t>(4 * row + 3)] = static_cast<float>(moved);
  }
  return result;
}

double millisecondsOf(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

/// Share of the pixels in which two pictures differ by more than 8 in a channel.
double differing(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
  GLuint count = 0;
  for (GLuint i = 0; i < pixels; ++i)
  {
    int most = 0;
    for (GLuint k = 0; k < 3; ++k)
    {
      most = std::max(most, std::abs(int(a[4 * i + k]) - int(b[4 * i + k])));
    }
    count += most > 8 ? 1 : 0;
  }
  return static_cast<double>(count) / pixels;
}

/// VTK remembers what it set.
void leaveToVTK(vtkRenderWindow* window)
{
  glUseProgram(0);
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  glDepthFunc(GL_LEQUAL);
  vtkOpenGLState* const state = vtkOpenGLRenderWindow::SafeDownCast(window)->GetState();
  state->Reset();
  state->ResetFramebufferBindings();
}

std::vector<unsigned char> pictureOf(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> rgba;
  window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 1, rgba);
  return { rgba->GetPointer(0), rgba->GetPointer(0) + rgba->GetNumberOfValues() };
}

std::string styleOf(double metres)
{
  const std::string technique = metres == 0.0
    ? R"("technique": "points", "size": {"mode": "fixed", "px": 1})"
    : R"("technique": "splats", "blended": true, "orientation": "view", "size": )"
      R"({"mode": "fixed", "metres": )" +
      std::to_string(2.0 * metres) + "}";
  return "{\"default\": {" + technique + "}}";
}

/// The four ways of drawing one cloud, and the camera that goes around it.
class Race
{
public:
  Race(vtkPointFrontReader* reader, const Cloud& cloud)
    : cloud_(cloud)
  {
    mapper_->SetInputConnection(reader->GetOutputPort());
    mapper_->SetScalarModeToUsePointFieldData();
    mapper_->SelectColorArray("rgb");
    mapper_->SetTargetError(0.001);
    mapper_->SetPointBudget(static_cast<vtkIdType>(cloud.points.size()));
    mapper_->CompleteOn();
    mapper_->SetStyle(style_);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper_);
    actor->GetProperty()->LightingOff();
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);
    renderer_->AddActor(actor);
    camera_ = renderer_->GetActiveCamera();
    camera_->SetPosition(1.0, -1.0, 1.0);
    camera_->SetFocalPoint(0.0, 0.0, 0.0);
    camera_->SetViewUp(0.0, 0.0, 1.0);
    renderer_->ResetCamera(mapper_->GetBounds());
    camera_->Zoom(1.5);
    window_->Render();
    window_->MakeCurrent();
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (10 * major + minor < 43)
    {
      fail("the driver has OpenGL " + std::to_string(major) + "." + std::to_string(minor) +
        "; compute shaders need 4.3");
    }
    raw_ = std::make_unique<RawScene>(cloud.points);
  }

  /// `metres`: of a disc's radius; 0: points of one pixel.
  nlohmann::ordered_json run(double metres, int rounds)
  {
    if (!style_->LoadJSON(styleOf(metres)))
    {
      fail("the style is refused");
    }
    times_.clear();
    rawApart_ = backendsApart_ = 0.0;
    for (int round = 0; round <= rounds; ++round)
    {
      isCounted_ = round > 0; // the first one uploads and compiles
      camera_->Azimuth(2.0);
      renderer_->ResetCameraClippingRange(mapper_->GetBounds());
      runRaw(static_cast<float>(metres));
      runMapper();
    }
    nlohmann::ordered_json result;
    for (auto& [name, ms] : times_)
    {
      std::sort(ms.begin(), ms.end());
      result[name] = { { "median_ms", ms[ms.size() / 2] }, { "min_ms", ms.front() } };
    }
    result["points drawn by the mapper"] = mapper_->GetLastPointsDrawn();
    result["pixels in which raster and compute differ"] = rawApart_;
    result["pixels in which the mapper's back ends differ"] = backendsApart_;
    return result;
  }

private:
  void measure(const std::string& name, const std::function<void()>& work)
  {
    const double time = millisecondsOf(work);
    if (isCounted_)
    {
      times_[name].push_back(time);
    }
  }

  void runRaw(float metres)
  {
    window_->MakeCurrent();
    const std::array<float, 16> matrix = clipMatrix(renderer_, cloud_.centre);
    measure("raster", [&] { raw_->raster(matrix, metres); });
    const std::vector<unsigned char> rastered = raw_->read();
    measure("compute", [&] { raw_->compute(matrix, metres); });
    rawApart_ = std::max(rawApart_, differing(rastered, raw_->read()));
    leaveToVTK(window_);
  }

  void runMapper()
  {
    std::vector<unsigned char> pictures[2];
    for (const int backend : { 0, 1 })
    {
      backend == 0 ? mapper_->SetBackendToOpenGL() : mapper_->SetBackendToSoftware();
      camera_->Azimuth(-1.0); // brings its arrays; a view at rest would not be drawn again
      window_->Render();
      camera_->Azimuth(1.0);
      measure(backend == 0 ? "opengl" : "software", [&] { window_->Render(); });
      pictures[backend] = pictureOf(window_);
    }
    backendsApart_ = std::max(backendsApart_, differing(pictures[0], pictures[1]));
  }

  const Cloud& cloud_;
  vtkNew<vtkPointFrontStyle> style_;
  vtkNew<vtkPointFrontMapper> mapper_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkCamera* camera_ = nullptr;
  std::unique_ptr<RawScene> raw_;
  std::map<std::string, std::vector<double>> times_; ///< milliseconds
  bool isCounted_ = false;
  double rawApart_ = 0.0, backendsApart_ = 0.0; ///< shares of the pixels
};

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2 || argc > 4)
  {
    fail("usage: pointfrontComputeBenchmark STORE.pfront [ROUNDS [POINTS]]");
  }
  const int rounds = argc > 2 ? std::stoi(argv[2]) : 7;
  const vtkIdType most = argc > 3 ? std::stoll(argv[3]) : VTK_ID_MAX;
  const vtkSmartPointer<vtkPointFrontReader> reader = openReader(argv[1]);
  const Cloud cloud = packed(allPoints(*reader->GetStore()->GetStore()), most);
  Race race(reader, cloud);
  nlohmann::ordered_json result;
  result["driver"] = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  result["points"] = cloud.points.size();
  result["points of one pixel"] = race.run(0.0, rounds);
  result["blended discs"] = race.run(cloud.spacing, rounds);
  std::printf("%s\n", result.dump(2).c_str());
  return 0;
}
