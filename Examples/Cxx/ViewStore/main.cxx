// The shortest viewer: shows a store in a window, until it is closed.
//   ViewStore STORE.pfront
#include <vtkActor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPointFrontMapper.h>
#include <vtkPointFrontReader.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

int main(int, char* argv[])
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkPointFrontMapper> mapper; // a vtkPolyDataMapper like any other
  mapper->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(1280, 720);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  window->Render();
  mapper->RenderWhenDataArrives(interactor); // the picture refines while nobody touches it
  interactor->Start();
}
