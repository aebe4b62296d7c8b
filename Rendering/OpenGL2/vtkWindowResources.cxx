#include "vtkWindowResources.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkWindowResources);

vtkWindowResources::vtkWindowResources()
{
  this->SetInputData(this->NoInput);
}

vtkWindowResources::~vtkWindowResources() = default;

void vtkWindowResources::Enter(vtkRenderer* renderer, vtkActor* actor)
{
  // Without points in its input the superclass registers with the window and does no more.
  this->RenderPiece(renderer, actor);
}

void vtkWindowResources::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Released)
  {
    this->Released();
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
