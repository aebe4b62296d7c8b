// A lens that follows the mouse: inside it vegetation is hidden.
//   LensStore STORE.pfront [PICTURE.png]
// With a picture the lens lies in the middle of it.
#include <vtkActor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointFrontLensWidget.h>
#include <vtkPointFrontMapper.h>
#include <vtkPointFrontReader.h>
#include <vtkPointFrontStyle.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkWindowToImageFilter.h>

#include <cstdio>

namespace
{

void interact(vtkRenderWindow* window, vtkPointFrontStyle* style, int lens)
{
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> camera;
  interactor->SetInteractorStyle(camera);
  interactor->SetRenderWindow(window);
  vtkNew<vtkPointFrontLensWidget> widget;
  widget->SetInteractor(interactor);
  widget->SetStyle(style);
  widget->SetLens(lens);
  widget->On();
  interactor->Initialize();
  window->Render();
  interactor->Start();
}

void writePicture(vtkRenderWindow* window, const char* fileName)
{
  window->SetOffScreenRendering(1);
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(fileName);
  writer->Write();
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 2 || argc > 3)
  {
    std::fprintf(stderr, "usage: LensStore STORE.pfront [PICTURE.png]\n");
    return 2;
  }
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  if (reader->GetErrorCode() != 0)
  {
    return 1; // VTK has said why
  }
  vtkNew<vtkPointFrontStyle> style;
  style->SetTechnique("splats");
  const int lens = style->AddCircleLens(480, 300, 120); // pixels, from the lower left corner
  style->SetLensStyle(lens, R"({"color": "intensity"})");
  for (const int vegetation : { 3, 4, 5 })
  {
    style->SetLensStyle(lens, R"({"visible": false})", vegetation);
  }

  vtkNew<vtkPointFrontMapper> mapper;
  mapper->SetInputConnection(reader->GetOutputPort());
  mapper->SetStyle(style);
  mapper->CompleteOn(); // a view at rest shows every point that it needs
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(960, 600);
  window->AddRenderer(renderer);

  if (argc == 3)
  {
    writePicture(window, argv[2]);
  }
  else
  {
    interact(window, style, lens);
  }
  std::printf("%lld points drawn\n", static_cast<long long>(mapper->GetLastPointsDrawn()));
  return 0;
}
