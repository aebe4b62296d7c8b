// usage: pointfrontFrameBenchmark STORE.pfront [ROUNDS [automatic|opengl|software]]
//
// Milliseconds for a frame of the same cloud from the same cameras, 1280 x 720, 2 px points:
//   all points in memory, drawn by vtkPolyDataMapper (in the store's order, which is a Morton order
//   inside each node),
//   all points, drawn by vtkPointFrontMapper (an error small enough),
//   vtkPointFrontMapper at its default error, points at most 1 pixel apart.
// The three take turns, round by round, while the camera goes around the cloud. JSON on stdout.

#include "BenchmarkCloud.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <nlohmann/json.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace
{

using namespace pointfront;

/// One way of drawing: an actor that is visible in its turn only, and its times.
struct Contestant
{
  std::string name;
  vtkNew<vtkActor> actor;
  std::vector<double> milliseconds;

  void dress(vtkMapper* mapper)
  {
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetPointSize(2.0f);
    actor->VisibilityOff();
  }
};

nlohmann::ordered_json summary(Contestant& contestant)
{
  std::vector<double>& ms = contestant.milliseconds;
  std::sort(ms.begin(), ms.end());
  return { { "median_ms", ms[ms.size() / 2] }, { "min_ms", ms.front() }, { "max_ms", ms.back() } };
}

double frameMs(vtkRenderWindow* window)
{
  const auto begin = std::chrono::steady_clock::now();
  window->Render();
  window->WaitForCompletion();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

void dressOurs(vtkPointFrontMapper* mapper, vtkPointFrontReader* reader, double error,
  const std::string& backend)
{
  backend == "opengl"       ? mapper->SetBackendToOpenGL()
    : backend == "software" ? mapper->SetBackendToSoftware()
                            : mapper->SetBackendToAutomatic();
  mapper->SetInputConnection(reader->GetOutputPort());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("rgb");
  mapper->SetTargetError(error);
  mapper->SetPointBudget(0);
  mapper->CompleteOn();
}

void lookFromAside(vtkRenderer* renderer, const double* bounds)
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->SetPosition(1.0, -1.0, 1.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera(bounds);
  camera->Zoom(1.5);
}

void showOffScreen(vtkRenderWindow* window, vtkRenderer* renderer)
{
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(1280, 720);
  window->AddRenderer(renderer);
}

/// Measures one frame. Gives the points drawn, 0 for a mapper of VTK.
/// A cloud out of sight gives back its GPU memory: the frame before brings it there, and looks at
/// another view, so that no frame is the one before once more.
vtkIdType takeTurn(
  Contestant& contestant, vtkRenderWindow* window, vtkRenderer* renderer, const double* bounds)
{
  contestant.actor->VisibilityOn();
  frameMs(window);
  renderer->GetActiveCamera()->Azimuth(2.0);
  renderer->ResetCameraClippingRange(bounds);
  contestant.milliseconds.push_back(frameMs(window));
  auto* const ours = vtkPointFrontMapper::SafeDownCast(contestant.actor->GetMapper());
  renderer->GetActiveCamera()->Azimuth(-2.0);
  contestant.actor->VisibilityOff();
  return ours ? ours->GetLastPointsDrawn() : 0;
}

} // namespace

int main(int argc, char** argv)
{
  const std::string backend = argc == 4 ? argv[3] : "automatic";
  const bool known = backend == "automatic" || backend == "opengl" || backend == "software";
  if (argc < 2 || argc > 4 || !known)
  {
    fail("usage: pointfrontFrameBenchmark STORE.pfront [ROUNDS [automatic|opengl|software]]");
  }
  const int rounds = argc >= 3 ? std::stoi(argv[2]) : 9;
  const vtkSmartPointer<vtkPointFrontReader> reader = openReader(argv[1]);

  Contestant theirs;
  theirs.name = "vtkPolyDataMapper, all points";
  vtkNew<vtkPolyDataMapper> theirMapper;
  theirMapper->SetInputData(allPoints(*reader->GetStore()->GetStore()));
  theirs.dress(theirMapper);
  Contestant all;
  all.name = "vtkPointFrontMapper, all points";
  vtkNew<vtkPointFrontMapper> allMapper;
  dressOurs(allMapper, reader, 0.01, backend);
  all.dress(allMapper);
  Contestant front;
  front.name = "vtkPointFrontMapper, error 1 px";
  vtkNew<vtkPointFrontMapper> frontMapper;
  dressOurs(frontMapper, reader, 1.0, backend);
  front.dress(frontMapper);

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  showOffScreen(window, renderer);
  Contestant* const contestants[] = { &theirs, &all, &front };
  for (Contestant* contestant : contestants)
  {
    renderer->AddActor(contestant->actor);
  }
  lookFromAside(renderer, frontMapper->GetBounds());

  nlohmann::ordered_json result;
  vtkIdType drawn[] = { 0, 0, 0 };
  for (int round = 0; round < rounds; ++round)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      drawn[c] = takeTurn(*contestants[c], window, renderer, frontMapper->GetBounds());
    }
    renderer->GetActiveCamera()->Azimuth(2.0);
  }
  result["points"] = reader->GetStore()->GetNumberOfPoints();
  result["rounds"] = rounds;
  result["backend"] = backend;
  for (Contestant* contestant : contestants)
  {
    result[contestant->name] = summary(*contestant);
  }
  result["points drawn, all points"] = drawn[1];
  result["points drawn, error 1 px"] = drawn[2];
  std::printf("%s\n", result.dump(2).c_str());
  return 0;
}
