// The properties of vtkPointFrontRepresentation that are handed on as they are.
#include "vtkPointFrontRepresentation.h"

#include "CloudActor.h"
#include "StyleChoice.h"

#include "vtkNew.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"
#include "vtkTransform.h"

namespace
{

std::string textOf(const char* value)
{
  return value ? value : "";
}

} // namespace

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPointBudget(vtkIdType points)
{
  this->Mapper->SetPointBudget(points);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetGPUMemoryBudget(int mebibytes)
{
  this->Mapper->SetGPUMemoryBudget(static_cast<vtkTypeInt64>(mebibytes) << 20);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetDetailSelection(int method)
{
  this->Mapper->SetDetailSelection(method);
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::GetHostMemoryBudget()
{
  return static_cast<int>(vtkPointFrontStore::GetProcessMemoryBudget() >> 20);
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::GetNumberOfClasses()
{
  return this->Store ? this->Store->GetNumberOfObjectClasses() : 0;
}

//------------------------------------------------------------------------------
const char* vtkPointFrontRepresentation::GetNameOfClass(int index)
{
  return this->Store ? this->Store->GetObjectClassName(index) : nullptr;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClassVisibility(const char* name, int shown)
{
  if (shown != 0)
  {
    this->HiddenClasses.erase(name);
  }
  else
  {
    this->HiddenClasses.insert(name);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassTargetErrorFactors()
{
  this->ClassFactors.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClassTargetErrorFactor(const char* name, double factor)
{
  this->ClassFactors[name] = factor;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassBudgetShares()
{
  this->ClassShares.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClassBudgetShare(const char* name, double share)
{
  this->ClassShares[name] = share;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLookupTable(vtkScalarsToColors* table)
{
  this->Table = table;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPointSize(double pixels)
{
  this->PointSize = pixels;
  this->Property->SetPointSize(static_cast<float>(pixels));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetTechnique(const char* name)
{
  this->Choice->look.technique = name ? name : "";
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetQuality(const char* name)
{
  const std::string quality = name ? name : "";
  this->Choice->look.quality = quality == "custom" ? std::string() : quality;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClosingSize(int closing)
{
  this->Choice->look.closing = closing;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetSizeFactor(double factor)
{
  this->Choice->look.factor = factor;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetEyeDomeStrength(double strength)
{
  this->Choice->look.eyeDomeStrength = strength;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLit(int light)
{
  this->Choice->look.light = light;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetFillHoles(bool fill)
{
  this->Choice->look.fillHoles = fill;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetWhere(const char* condition)
{
  this->Choice->look.where = condition ? condition : "";
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetBackend(int backend)
{
  this->Mapper->SetBackend(backend);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetStyleFile(const char* fileName)
{
  this->Choice->setFile(fileName ? fileName : "");
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassStyles()
{
  this->Choice->classes.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AddClassStyle(
  const char* classCode, const char* technique, const char* color, const char* size)
{
  this->Choice->classes.add(textOf(classCode), textOf(technique), textOf(color), textOf(size));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassLights()
{
  this->Choice->lights.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AddClassLight(
  const char* classCode, const char* light, const char* eyeDomeStrength)
{
  this->Choice->lights.addLight(textOf(classCode), textOf(light), textOf(eyeDomeStrength));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensShape(int shape)
{
  this->Choice->lens.place.shape = shape;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensCenter(double x, double y)
{
  this->Choice->lens.place.centre = { { x, y } };
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensRadius(double radius)
{
  this->Choice->lens.place.radius = radius;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensSize(double width, double height)
{
  this->Choice->lens.place.size = { { width, height } };
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensMask(const char* fileName)
{
  this->Choice->lens.setMaskFile(textOf(fileName));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensClass(int classCode)
{
  this->Choice->lens.place.aroundClass = classCode;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensClassRadius(double radius)
{
  this->Choice->lens.place.aroundRadius = radius;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearLensStyles()
{
  this->Choice->lens.classes.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AddLensStyle(
  const char* classCode, const char* technique, const char* color, const char* size)
{
  this->Choice->lens.classes.add(
    textOf(classCode), textOf(technique), textOf(color), textOf(size), true);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetGrowthTime(double milliseconds)
{
  this->Mapper->SetGrowthTime(milliseconds);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetOpacity(double opacity)
{
  this->Opacity = opacity;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetAmbientColor(double r, double g, double b)
{
  this->Property->SetAmbientColor(r, g, b);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetDiffuseColor(double r, double g, double b)
{
  this->Property->SetDiffuseColor(r, g, b);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPosition(double x, double y, double z)
{
  this->Position = { x, y, z };
  this->Actor->SetPosition(
    x + this->Translation[0], y + this->Translation[1], z + this->Translation[2]);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetTranslation(double x, double y, double z)
{
  this->Translation = { x, y, z };
  this->SetPosition(this->Position[0], this->Position[1], this->Position[2]);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetUserTransform(const double matrix[16])
{
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(matrix);
  this->Actor->SetUserTransform(transform);
}
