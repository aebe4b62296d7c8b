#include "RendererClouds.h"

#include "vtkPointFrontMapper.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkProp3DCollection.h>
#include <vtkPropAssembly.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

namespace pointfront
{
namespace
{

bool showsCloud(vtkProp* prop)
{
  vtkActor* const actor = vtkActor::SafeDownCast(prop);
  return actor && vtkPointFrontMapper::SafeDownCast(actor->GetMapper()) != nullptr;
}

int cloudsAmong(vtkPropCollection& props);

/// An assembly is asked for its parts, not for its actors: it draws by going through its paths, and
/// to list actors begins that anew.
int cloudsOf(vtkProp* prop)
{
  if (!prop->GetVisibility())
  {
    return 0;
  }
  if (vtkAssembly* const assembly = vtkAssembly::SafeDownCast(prop))
  {
    return cloudsAmong(*assembly->GetParts());
  }
  if (vtkPropAssembly* const assembly = vtkPropAssembly::SafeDownCast(prop))
  {
    return cloudsAmong(*assembly->GetParts());
  }
  if (showsCloud(prop))
  {
    return 1;
  }
  vtkNew<vtkPropCollection> actors; // a level of detail has some
  prop->GetActors(actors);
  int clouds = 0;
  vtkCollectionSimpleIterator at;
  actors->InitTraversal(at);
  while (vtkProp* const actor = actors->GetNextProp(at))
  {
    clouds += actor->GetVisibility() && showsCloud(actor) ? 1 : 0;
  }
  return clouds;
}

int cloudsAmong(vtkPropCollection& props)
{
  int clouds = 0;
  vtkCollectionSimpleIterator at;
  props.InitTraversal(at);
  while (vtkProp* const prop = props.GetNextProp(at))
  {
    clouds += cloudsOf(prop);
  }
  return clouds;
}

} // namespace

bool hasSeveralClouds(vtkRenderer* renderer)
{
  return cloudsAmong(*renderer->GetViewProps()) > 1;
}

} // namespace pointfront
