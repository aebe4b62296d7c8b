#include "SelectionMarks.h"

#include "vtkActorCollection.h"
#include "vtkPVLODActor.h"
#include "vtkRenderer.h"

namespace pointfront
{

void SelectionMarks::takeOut(vtkRenderer* renderer)
{
  vtkActorCollection* const actors = renderer->GetActors();
  for (int i = 0; i < actors->GetNumberOfItems(); ++i)
  {
    auto* actor = vtkPVLODActor::SafeDownCast(actors->GetItemAsObject(i));
    if (actor && !actor->GetPickable())
    {
      out_.emplace_back(actor);
    }
  }
  for (const auto& mark : out_)
  {
    renderer->RemoveActor(mark);
  }
}

void SelectionMarks::putBack(vtkRenderer* renderer)
{
  for (const auto& mark : out_)
  {
    mark ? renderer->AddActor(mark) : void();
  }
  out_.clear();
}

} // namespace pointfront
