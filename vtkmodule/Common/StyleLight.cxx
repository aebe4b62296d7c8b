#include "vtkPointFrontStyle.h"

#include "pointfront/Style/StyleLooks.h"
#include "pointfront/Style/StyleSheet.h"

#include <string>

bool vtkPointFrontStyle::IsNumber(double value, double most, const char* what, int objectClass)
{
  if (!(value >= 0.0 && value <= most))
  {
    const std::string where =
      objectClass == DEFAULT_CLASS ? "default" : "class " + std::to_string(objectClass);
    vtkErrorMacro(<< where << ": " << what << " is from 0 to " << most << ", not " << value);
    return false;
  }
  return this->IsClass(objectClass);
}

pointfront::FrameLook vtkPointFrontStyle::LookOf(int objectClass) const
{
  return pointfront::lookOf(this->StyleOf(objectClass), this->Sheet->shading);
}

/// `objectClass` is one, or the default.
template <typename Change>
bool vtkPointFrontStyle::ChangeLight(int objectClass, const Change& change)
{
  pointfront::StyleSheet sheet = *this->Sheet;
  const pointfront::LayerStyle known = this->StyleOf(objectClass);
  pointfront::LayerStyle& style = objectClass == DEFAULT_CLASS
    ? sheet.standard
    : sheet.classes[static_cast<std::uint8_t>(objectClass)];
  pointfront::StyleLight light =
    known.light.value_or(pointfront::StyleLight{ this->GetLit(objectClass), {}, {} });
  change(light);
  style.light = light;
  return this->SetStyleSheet(sheet);
}

bool vtkPointFrontStyle::SetLit(bool lit, int objectClass)
{
  return this->IsClass(objectClass) &&
    this->ChangeLight(objectClass, [lit](pointfront::StyleLight& light) { light.on = lit; });
}

bool vtkPointFrontStyle::GetLit(int objectClass) const
{
  return this->LookOf(objectClass).lit;
}

bool vtkPointFrontStyle::SetAmbient(double share, int objectClass)
{
  return this->IsNumber(share, pointfront::mostLight, "ambient light", objectClass) &&
    this->ChangeLight(objectClass,
      [share](pointfront::StyleLight& light) { light.ambient = static_cast<float>(share); });
}

double vtkPointFrontStyle::GetAmbient(int objectClass) const
{
  const auto light = this->StyleOf(objectClass).light;
  return light && light->ambient ? *light->ambient : this->Sheet->shading.ambient;
}

bool vtkPointFrontStyle::SetDiffuse(double share, int objectClass)
{
  return this->IsNumber(share, pointfront::mostLight, "diffuse light", objectClass) &&
    this->ChangeLight(objectClass,
      [share](pointfront::StyleLight& light) { light.diffuse = static_cast<float>(share); });
}

double vtkPointFrontStyle::GetDiffuse(int objectClass) const
{
  const auto light = this->StyleOf(objectClass).light;
  return light && light->diffuse ? *light->diffuse : this->Sheet->shading.diffuse;
}

/// `objectClass` is one, or the default.
template <typename Change>
bool vtkPointFrontStyle::ChangeEyeDome(int objectClass, const Change& change)
{
  pointfront::StyleSheet sheet = *this->Sheet;
  const pointfront::LayerStyle known = this->StyleOf(objectClass);
  pointfront::LayerStyle& style = objectClass == DEFAULT_CLASS
    ? sheet.standard
    : sheet.classes[static_cast<std::uint8_t>(objectClass)];
  pointfront::StyleEyeDome eyeDome = known.eyeDome.value_or(
    pointfront::StyleEyeDome{ this->GetEyeDomeStrength(objectClass) > 0.0, {}, {} });
  change(eyeDome);
  style.eyeDome = eyeDome;
  return this->SetStyleSheet(sheet);
}

bool vtkPointFrontStyle::SetEyeDomeStrength(double strength, int objectClass)
{
  return this->IsNumber(strength, pointfront::mostEyeDomeStrength, "the strength", objectClass) &&
    this->ChangeEyeDome(objectClass,
      [strength](pointfront::StyleEyeDome& eyeDome)
      {
        eyeDome.on = strength > 0.0;
        eyeDome.strength.reset();
        if (eyeDome.on)
        {
          eyeDome.strength = static_cast<float>(strength);
        }
      });
}

double vtkPointFrontStyle::GetEyeDomeStrength(int objectClass) const
{
  return this->LookOf(objectClass).eyeDomeStrength;
}

bool vtkPointFrontStyle::SetEyeDomeRadius(double pixels, int objectClass)
{
  return this->IsNumber(pixels, pointfront::mostEyeDomeRadiusPx, "the radius", objectClass) &&
    this->ChangeEyeDome(objectClass,
      [pixels](pointfront::StyleEyeDome& eyeDome)
      { eyeDome.radiusPx = static_cast<float>(pixels); });
}

double vtkPointFrontStyle::GetEyeDomeRadius(int objectClass) const
{
  const auto eyeDome = this->StyleOf(objectClass).eyeDome;
  return eyeDome && eyeDome->radiusPx ? *eyeDome->radiusPx : this->Sheet->shading.eyeDomeRadiusPx;
}
