// Uses the installed VTK modules and nothing else: draws all of a store offscreen, counts the
// points drawn and the pixels that they cover.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPointFrontMapper.h>
#include <vtkPointFrontReader.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>

namespace
{

/// Pixels that are not black. Of an 8-bit RGB image.
long coveredPixels(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  const int* size = window->GetSize();
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, /*front=*/0, pixels);
  long covered = 0;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    const unsigned char* rgb = pixels->GetPointer(3 * i);
    covered += rgb[0] != 0 || rgb[1] != 0 || rgb[2] != 0;
  }
  return covered;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: VTKConsumer STORE\n");
    return 2;
  }
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkPointFrontMapper> mapper;
  mapper->SetInputConnection(reader->GetOutputPort());
  mapper->SetTargetError(0.01); // finer than the cloud: every point
  mapper->SetPointBudget(0);
  mapper->CompleteOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(640, 480);
  window->AddRenderer(renderer);
  renderer->ResetCamera(mapper->GetBounds());
  window->Render();

  const long covered = coveredPixels(window);
  std::printf("%lld points drawn, %ld pixels covered\n",
    static_cast<long long>(mapper->GetLastPointsDrawn()), covered);
  // Seen from above, the square cloud spans most of the window's height.
  const long least = 640L * 480L / 5;
  if (!mapper->GetLastComplete() || covered < least)
  {
    std::fprintf(stderr, "expected a complete picture with %ld pixels or more\n", least);
    return 1;
  }
  return 0;
}
