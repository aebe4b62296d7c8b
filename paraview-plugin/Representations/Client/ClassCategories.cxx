#include "ClassCategories.h"

#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Style/StandardColours.h"

#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

namespace pointfront
{
namespace
{

/// Annotation of a map that was named: what its "Annotations" were then. Who changed them since
/// owns the map.
constexpr const char* Named = "PointFrontClasses";

using Colour = std::array<double, 3>;
using Categories = std::map<int, std::pair<std::string, Colour>>; // by class code

/// The codes of those names; of a store whose classes are not told apart, each code between the
/// smallest and the largest of the representation's input.
std::set<int> codesOf(vtkSMProxy* representation, const std::vector<std::string>& classes)
{
  std::set<int> codes;
  for (int code = 0; code < 256 && !classes.empty(); ++code)
  {
    const std::string name = objectClassName(static_cast<std::uint8_t>(code));
    if (std::find(classes.begin(), classes.end(), name) != classes.end())
    {
      codes.insert(code);
    }
  }
  const vtkSMPropertyHelper input(representation, "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkPVDataInformation* data = source ? source->GetDataInformation(input.GetOutputPort()) : nullptr;
  vtkPVArrayInformation* array =
    data ? data->GetPointDataInformation()->GetArrayInformation("classification") : nullptr;
  if (!codes.empty() || !array || array->GetNumberOfComponents() != 1)
  {
    return codes;
  }
  const double* range = array->GetComponentRange(0);
  const auto code = [](double value) { return static_cast<int>(std::lround(value)); };
  for (int c = code(std::max(range[0], 0.0)); c <= code(std::min(range[1], 255.0)); ++c)
  {
    codes.insert(c);
  }
  return codes;
}

std::string textOf(vtkSMProxy* map)
{
  std::string text;
  const vtkSMPropertyHelper annotations(map, "Annotations");
  for (unsigned int i = 0; i < annotations.GetNumberOfElements(); ++i)
  {
    text += annotations.GetAsString(i) + std::string("\n");
  }
  return text;
}

/// The categories of a map, with the colours that a user may have changed.
Categories categoriesOf(vtkSMProxy* map)
{
  Categories categories;
  const vtkSMPropertyHelper annotations(map, "Annotations");
  const vtkSMPropertyHelper colours(map, "IndexedColors");
  for (unsigned int i = 0; 2 * i + 1 < annotations.GetNumberOfElements(); ++i)
  {
    Colour colour{ { 1.0, 1.0, 1.0 } };
    for (unsigned int c = 0; c < 3 && 3 * i + c < colours.GetNumberOfElements(); ++c)
    {
      colour[c] = colours.GetAsDouble(3 * i + c);
    }
    categories.emplace(std::atoi(annotations.GetAsString(2 * i)),
      std::make_pair(annotations.GetAsString(2 * i + 1), colour));
  }
  return categories;
}

void setCategories(vtkSMProxy* map, const Categories& categories)
{
  vtkSMPropertyHelper annotations(map, "Annotations");
  annotations.SetNumberOfElements(2 * static_cast<unsigned int>(categories.size()));
  std::vector<double> colours;
  unsigned int i = 0;
  for (const auto& [code, category] : categories)
  {
    annotations.Set(i++, std::to_string(code).c_str());
    annotations.Set(i++, category.first.c_str());
    colours.insert(colours.end(), category.second.begin(), category.second.end());
  }
  vtkSMPropertyHelper(map, "IndexedColors")
    .Set(colours.data(), static_cast<unsigned int>(colours.size()));
  vtkSMPropertyHelper(map, "IndexedLookup").Set(1);
  map->UpdateVTKObjects();
}

} // namespace

void nameClasses(vtkSMProxy* representation, const std::vector<std::string>& classes)
{
  const char* const array =
    vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
  vtkSMProxy* const map = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (!array || std::string(array) != "classification" || !map)
  {
    return;
  }
  const std::string before = map->HasAnnotation(Named) ? map->GetAnnotation(Named) : "";
  if (textOf(map) != before)
  {
    return; // somebody else has named them, or nobody shall
  }
  Categories categories = categoriesOf(map);
  const std::size_t known = categories.size();
  const auto standard = classificationColours();
  for (const int code : codesOf(representation, classes))
  {
    const auto& rgb = standard[static_cast<std::size_t>(code)];
    categories.emplace(code,
      std::make_pair(objectClassName(static_cast<std::uint8_t>(code)),
        Colour{ { rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0 } }));
  }
  if (categories.size() > known)
  {
    setCategories(map, categories);
    map->SetAnnotation(Named, textOf(map).c_str());
  }
}

} // namespace pointfront
