#include "ClassCategories.h"

#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Style/StandardColours.h"

#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{
namespace
{

/// Set on a map that was named.
constexpr const char* Named = "PointFrontClasses";
/// More entries than this are no legend.
constexpr int MostClasses = 64;

/// Smallest and largest code of the representation's input; false without any.
bool codesOf(vtkSMProxy* representation, int codes[2])
{
  const vtkSMPropertyHelper input(representation, "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkPVDataInformation* data = source ? source->GetDataInformation(input.GetOutputPort()) : nullptr;
  vtkPVArrayInformation* array =
    data ? data->GetPointDataInformation()->GetArrayInformation("classification") : nullptr;
  if (!array || array->GetNumberOfComponents() != 1)
  {
    return false;
  }
  const double* range = array->GetComponentRange(0);
  codes[0] = static_cast<int>(std::lround(std::clamp(range[0], 0.0, 255.0)));
  codes[1] = static_cast<int>(std::lround(std::clamp(range[1], 0.0, 255.0)));
  return range[0] <= range[1];
}

} // namespace

void nameClasses(vtkSMProxy* representation)
{
  const char* const array =
    vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  vtkSMProxy* const map = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  int codes[2];
  if (!array || std::string(array) != "classification" || !map || map->HasAnnotation(Named) ||
    !codesOf(representation, codes))
  {
    return;
  }
  map->SetAnnotation(Named, "1");
  if (vtkSMPropertyHelper(map, "Annotations").GetNumberOfElements() > 0 ||
    codes[1] - codes[0] >= MostClasses)
  {
    return; // somebody has named them
  }
  const auto standard = classificationColours();
  std::vector<std::string> names;
  std::vector<double> colours;
  for (int code = codes[0]; code <= codes[1]; ++code)
  {
    names.push_back(std::to_string(code));
    names.push_back(objectClassName(static_cast<std::uint8_t>(code)));
    for (std::size_t c = 0; c < 3; ++c)
    {
      colours.push_back(standard[static_cast<std::size_t>(code)][c] / 255.0);
    }
  }
  vtkSMPropertyHelper annotations(map, "Annotations");
  annotations.SetNumberOfElements(static_cast<unsigned int>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    annotations.Set(static_cast<unsigned int>(i), names[i].c_str());
  }
  vtkSMPropertyHelper(map, "IndexedColors")
    .Set(colours.data(), static_cast<unsigned int>(colours.size()));
  vtkSMPropertyHelper(map, "IndexedLookup").Set(1);
  map->UpdateVTKObjects();
}

} // namespace pointfront
