/// The part of vtkPointFrontRepresentation for colours, styles and classes of the frame that comes.

#include "vtkPointFrontRepresentation.h"

#include "StyleChoice.h"

#include "vtkDataObject.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkInformation.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"
#include "vtkPointFrontStyle.h"
#include "vtkProperty.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"

#include <algorithm>

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrepareClasses()
{
  const auto valueOf =
    [](const std::map<std::string, double>& values, const char* name, double otherwise)
  {
    const auto found = values.find(name);
    return found != values.end() ? found->second : otherwise;
  };
  vtkPointFrontStore* store = this->Mapper->GetStore();
  for (int i = 0; store && i < store->GetNumberOfObjectClasses(); ++i)
  {
    const char* name = store->GetObjectClassName(i);
    const int number = store->GetObjectClassNumber(i);
    this->Mapper->SetClassVisibility(number, this->HiddenClasses.count(name) == 0);
    this->Mapper->SetClassTargetErrorFactor(number, valueOf(this->ClassFactors, name, 1.0));
    this->Mapper->SetClassBudgetShare(number, valueOf(this->ClassShares, name, 0.0));
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrepareColors()
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const char* array = info && info->Has(vtkDataObject::FIELD_NAME())
    ? info->Get(vtkDataObject::FIELD_NAME())
    : nullptr;
  const bool ofPoints = info && info->Has(vtkDataObject::FIELD_ASSOCIATION()) &&
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  if (!array || !array[0] || !ofPoints)
  {
    this->Mapper->ScalarVisibilityOff();
    this->DrawnArray.clear();
    this->PrepareStyle();
    return;
  }
  const bool color = IsColor(array);
  if (!color && !this->ToldOfNames && this->Mapper->GetStorePiece() == 0)
  {
    vtkWarningMacro("\"" << array << "\" names points and is no colour: they are shown by height");
  }
  this->ToldOfNames = !color;
  this->Mapper->SetLookupTable(color ? this->DrawnTable() : this->HeightTable());
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarModeToUsePointFieldData();
  this->Mapper->SelectColorArray(color ? array : "elevation");
  this->Mapper->UseLookupTableScalarRangeOn();
  const bool direct = !this->MapScalars || (this->DirectColors && array == std::string("rgb"));
  if (!this->MapScalars)
  {
    this->Mapper->SetColorModeToDirectScalars();
  }
  else if (this->DirectColors)
  {
    this->Mapper->SetColorModeToDefault();
  }
  else
  {
    this->Mapper->SetColorModeToMapScalars();
  }
  this->DrawnArray = color ? array : "elevation";
  this->DrawnDirectly = direct;
  this->PrepareStyle();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrepareStyle()
{
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  if (!view)
  {
    return;
  }
  pointfront::LookColour colour;
  colour.array = this->DrawnArray;
  colour.direct = !this->DrawnArray.empty() && this->DrawnDirectly;
  colour.table = this->Mapper->GetLookupTable();
  std::copy_n(this->Property->GetColor(), 3, colour.flat.begin());
  pointfront::PointLook& look = this->Choice->look;
  look.pixels = this->PointSize;
  // By depth, which translucent actors do not write, ranks put their pictures together.
  look.opacity = this->Opacity;
  look.translucentSurface = this->Mapper->GetNumberOfStorePieces() > 1;
  this->Property->SetOpacity(look.translucentSurface ? 1.0 : this->Opacity);
  std::string error;
  const int* const size = view->GetRenderer()->GetSize();
  vtkPointFrontStyle* const style = this->Choice->style(colour, size[0], size[1], error);
  this->Mapper->SetStyle(style);
  this->TellOpaqueMap(style != nullptr);
  if (!error.empty() && this->Mapper->GetStorePiece() == 0)
  {
    vtkErrorMacro(<< error);
  }
}

//------------------------------------------------------------------------------
vtkScalarsToColors* vtkPointFrontRepresentation::DrawnTable()
{
  auto* map = vtkDiscretizableColorTransferFunction::SafeDownCast(this->Table);
  if (!map || !map->GetEnableOpacityMapping() || this->Mapper->GetNumberOfStorePieces() < 2)
  {
    return this->Table;
  }
  // Translucent actors write no depth, by which ranks put their pictures together.
  if (!this->OpaqueMap || this->OpaqueMap->GetMTime() < map->GetMTime())
  {
    vtkNew<vtkDiscretizableColorTransferFunction> opaque;
    opaque->DeepCopy(map);
    opaque->EnableOpacityMappingOff();
    opaque->Build();
    this->OpaqueMap = opaque;
  }
  return this->OpaqueMap;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::TellOpaqueMap(bool styled)
{
  auto* map = vtkDiscretizableColorTransferFunction::SafeDownCast(this->Table);
  const bool lost = map && map->GetEnableOpacityMapping() && !this->DrawnArray.empty() &&
    !this->DrawnDirectly && (styled || this->Mapper->GetNumberOfStorePieces() > 1);
  if (lost && !this->ToldOfOpaqueMap && this->Mapper->GetStorePiece() == 0)
  {
    vtkWarningMacro("the opacities of the color map are left out: only points in no style, on one "
                    "process, have them. Opacity (Styling) holds for all.");
  }
  this->ToldOfOpaqueMap = lost;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::TellLensOfRanks(bool oneSurface)
{
  const pointfront::LensChoice& lens = this->Choice->lens;
  const bool parted =
    oneSurface && lens.shows() && lens.place.shape == pointfront::LensPlace::AROUND_CLASS;
  if (parted && !this->ToldOfRanks && this->Mapper->GetStorePiece() == 0)
  {
    vtkWarningMacro("a lens around a class covers, on each rank, what that rank has of the class, "
                    "because the cloud as a whole is translucent: where ranks meet it has gaps.");
  }
  this->ToldOfRanks = parted;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PlaceLens()
{
  if (this->GetVisibility() && this->Choice->lens.place.shape != pointfront::LensPlace::NONE)
  {
    this->PrepareStyle();
  }
}

//------------------------------------------------------------------------------
vtkScalarsToColors* vtkPointFrontRepresentation::HeightTable()
{
  vtkPointFrontStore* store = this->Mapper->GetStore();
  if (store && !this->Heights)
  {
    double bounds[6];
    store->GetBounds(bounds);
    vtkNew<vtkLookupTable> greys;
    greys->SetRange(bounds[4], bounds[5]);
    greys->SetHueRange(0.0, 0.0);
    greys->SetSaturationRange(0.0, 0.0);
    greys->SetValueRange(0.2, 1.0);
    greys->Build();
    this->Heights = greys;
  }
  return this->Heights;
}
