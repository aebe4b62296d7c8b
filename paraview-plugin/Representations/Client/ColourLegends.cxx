#include "ColourLegends.h"

#include "vtkPointFrontRepresentation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMScalarBarWidgetRepresentationProxy.h"

#include <set>
#include <string>

namespace pointfront
{
namespace
{

bool isPointFront(vtkSMProxy* representation)
{
  const char* const type =
    vtkSMPropertyHelper(representation, "Representation", true).GetAsString();
  return type && std::string(type) == "Point Front";
}

/// Whether a representation is coloured by an array. (ParaView's own question moved to another
/// class with 5.12.)
bool isColoured(vtkSMProxy* representation)
{
  if (!representation->GetProperty("ColorArrayName") || !representation->GetProperty("LookupTable"))
  {
    return false;
  }
  const char* const array =
    vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  return array && *array;
}

/// Whether Point Front draws the colours that it was asked for through the colour map.
bool drawsThroughMap(vtkSMProxy* representation)
{
  const char* const array =
    vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  const bool mapped = vtkSMPropertyHelper(representation, "MapScalars").GetAsInt() != 0;
  const bool direct = vtkSMPropertyHelper(representation, "DirectColors").GetAsInt() != 0;
  return array && mapped && vtkPointFrontRepresentation::IsColor(array) &&
    !(direct && std::string(array) == "rgb");
}

} // namespace

void hideUnusedLegends(vtkSMProxy* view)
{
  std::set<vtkSMProxy*> used;
  std::set<vtkSMProxy*> unused;
  std::set<vtkSMProxy*> legends;
  const vtkSMPropertyHelper shown(view, "Representations");
  for (unsigned int i = 0; i < shown.GetNumberOfElements(); ++i)
  {
    vtkSMProxy* const proxy = shown.GetAsProxy(i);
    if (vtkSMPropertyHelper(proxy, "Visibility", true).GetAsInt() == 0)
    {
      continue;
    }
    if (vtkSMScalarBarWidgetRepresentationProxy::SafeDownCast(proxy))
    {
      legends.insert(proxy);
    }
    else if (isColoured(proxy))
    {
      const bool none = isPointFront(proxy) && !drawsThroughMap(proxy);
      (none ? unused : used).insert(vtkSMPropertyHelper(proxy, "LookupTable", true).GetAsProxy());
    }
  }
  for (vtkSMProxy* legend : legends)
  {
    vtkSMProxy* const map = vtkSMPropertyHelper(legend, "LookupTable").GetAsProxy();
    if (unused.count(map) != 0 && used.count(map) == 0)
    {
      vtkSMPropertyHelper(legend, "Visibility").Set(0);
      vtkSMPropertyHelper(legend, "Enabled").Set(0);
      legend->UpdateVTKObjects();
    }
  }
}

} // namespace pointfront
