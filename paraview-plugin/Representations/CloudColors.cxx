#include "CloudColors.h"

#include "PointLook.h"

#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"
#include "vtkScalarsToColors.h"

namespace pointfront
{

CloudColors::CloudColors() = default;
CloudColors::~CloudColors() = default;

std::string CloudColors::choose(
  vtkPointFrontMapper& mapper, const std::string& array, const Mapping& mapping)
{
  if (array.empty())
  {
    mapper.ScalarVisibilityOff();
    array_.clear();
    return {};
  }
  const bool colour = isColour(array);
  const bool news = !colour && !toldOfNames_;
  toldOfNames_ = !colour;
  mapper.SetLookupTable(colour ? drawnTable(mapper) : heightTable(mapper));
  mapper.ScalarVisibilityOn();
  mapper.SetScalarModeToUsePointFieldData();
  array_ = colour ? array : "elevation";
  mapper.SelectColorArray(array_.c_str());
  mapper.UseLookupTableScalarRangeOn();
  direct_ = !mapping.mapScalars || (mapping.directColors && array == "rgb");
  if (!mapping.mapScalars)
  {
    mapper.SetColorModeToDirectScalars();
  }
  else if (mapping.directColors)
  {
    mapper.SetColorModeToDefault();
  }
  else
  {
    mapper.SetColorModeToMapScalars();
  }
  return news ? "\"" + array + "\" names points and is no colour: they are shown by height"
              : std::string();
}

void CloudColors::describe(vtkPointFrontMapper& mapper, LookColour& colour) const
{
  colour.array = array_;
  colour.direct = !array_.empty() && direct_;
  colour.table = mapper.GetLookupTable();
}

bool CloudColors::tableHasOpacities() const
{
  auto* map = vtkDiscretizableColorTransferFunction::SafeDownCast(table);
  return map && map->GetEnableOpacityMapping();
}

std::string CloudColors::lostOpacities(vtkPointFrontMapper& mapper, bool styled)
{
  const bool lost = tableHasOpacities() && !array_.empty() && !direct_ &&
    (styled || mapper.GetNumberOfStorePieces() > 1);
  const bool news = lost && !toldOfOpacities_;
  toldOfOpacities_ = lost;
  return news ? "the opacities of the color map are left out: only points in no style, on one "
                "process, have them. Opacity (Styling) holds for all."
              : "";
}

/// The table; on several ranks without its opacities, because translucent actors write no depth, by
/// which ranks put their pictures together.
vtkScalarsToColors* CloudColors::drawnTable(vtkPointFrontMapper& mapper)
{
  if (!tableHasOpacities() || mapper.GetNumberOfStorePieces() < 2)
  {
    return table;
  }
  if (!opaque_ || opaque_->GetMTime() < table->GetMTime())
  {
    vtkNew<vtkDiscretizableColorTransferFunction> opaque;
    opaque->DeepCopy(table);
    opaque->EnableOpacityMappingOff();
    opaque->Build();
    opaque_ = opaque;
  }
  return opaque_;
}

/// Greys over the heights of the cloud; null without a store.
vtkScalarsToColors* CloudColors::heightTable(vtkPointFrontMapper& mapper)
{
  vtkPointFrontStore* const store = mapper.GetStore();
  if (store && !heights_)
  {
    double bounds[6];
    store->GetBounds(bounds);
    vtkNew<vtkLookupTable> greys;
    greys->SetRange(bounds[4], bounds[5]);
    greys->SetHueRange(0.0, 0.0);
    greys->SetSaturationRange(0.0, 0.0);
    greys->SetValueRange(0.2, 1.0);
    greys->Build();
    heights_ = greys;
  }
  return heights_;
}

} // namespace pointfront
