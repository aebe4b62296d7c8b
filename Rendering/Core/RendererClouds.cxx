#include "RendererClouds.h"

#include "vtkPointFrontMapper.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

namespace pointfront
{
namespace
{

bool showsCloud(vtkProp* prop)
{
  vtkActor* const actor = vtkActor::SafeDownCast(prop);
  return actor && actor->GetVisibility() &&
    vtkPointFrontMapper::SafeDownCast(actor->GetMapper()) != nullptr;
}

} // namespace

bool hasSeveralClouds(vtkRenderer* renderer)
{
  int clouds = 0;
  vtkPropCollection* const props = renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* const prop = props->GetNextProp(at))
  {
    if (!prop->GetVisibility())
    {
      continue;
    }
    vtkNew<vtkPropCollection> parts; // an assembly has several
    prop->GetActors(parts);
    vtkCollectionSimpleIterator part;
    parts->InitTraversal(part);
    while (vtkProp* const each = parts->GetNextProp(part))
    {
      clouds += showsCloud(each) ? 1 : 0;
    }
  }
  return clouds > 1;
}

} // namespace pointfront
