// Shows a store in a window, or writes a complete picture of it.
//   ShowStore STORE.pfront [PICTURE.png]
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointFrontMapper.h>
#include <vtkPointFrontReader.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkWindowToImageFilter.h>

#include <cstdio>

namespace
{

/// Draws what arrived since the last frame: the picture refines while nobody touches it.
void refine(vtkObject* caller, unsigned long, void* mapper, void*)
{
  if (static_cast<vtkPointFrontMapper*>(mapper)->NeedsRender())
  {
    static_cast<vtkRenderWindowInteractor*>(caller)->Render();
  }
}

void interact(vtkRenderWindow* window, vtkPointFrontMapper* mapper)
{
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  interactor->SetRenderWindow(window);
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(refine);
  command->SetClientData(mapper);
  interactor->AddObserver(vtkCommand::TimerEvent, command);
  interactor->Initialize();
  interactor->CreateRepeatingTimer(30); // milliseconds
  window->Render();
  interactor->Start();
}

void writePicture(vtkRenderWindow* window, vtkPointFrontMapper* mapper, const char* fileName)
{
  mapper->CompleteOn(); // wait for every point that the picture needs
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
    std::fprintf(stderr, "usage: ShowStore STORE.pfront [PICTURE.png]\n");
    return 2;
  }
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  if (reader->GetErrorCode() != 0)
  {
    return 1; // VTK has said why
  }
  vtkNew<vtkPointFrontMapper> mapper;
  mapper->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(1280, 720);
  window->AddRenderer(renderer);

  if (argc == 3)
  {
    writePicture(window, mapper, argv[2]);
  }
  else
  {
    interact(window, mapper);
  }
  std::printf("%lld points drawn\n", static_cast<long long>(mapper->GetLastPointsDrawn()));
  return 0;
}
