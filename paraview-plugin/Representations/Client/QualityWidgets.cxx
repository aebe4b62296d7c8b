#include "QualityWidgets.h"

#include "PointLook.h"

#include "pointfront/Style/QualityPreset.h"
#include "pointfront/Style/TechniqueNames.h"

#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

namespace pointfront
{

void agreeOnQuality(vtkSMProxy* representation, const std::string& changed)
{
  vtkSMPropertyHelper quality(representation, "Quality");
  const QualityPreset* const preset = qualityPresetOf(quality.GetAsString());
  if (!preset)
  {
    return;
  }
  vtkSMPropertyHelper technique(representation, "Technique");
  vtkSMPropertyHelper error(representation, "TargetError");
  vtkSMPropertyHelper closing(representation, "ClosingSize");
  const bool blended = preset->technique == Technique::Splats && preset->blended;
  const std::string name = blended ? "blended" : traitsOf(preset->technique).name;
  if (changed == "Quality")
  {
    technique.Set(name.c_str());
    error.Set(preset->errorPx);
    closing.Set(PointLook::BY_TECHNIQUE);
  }
  else if ((changed == "Technique" && technique.GetAsString() != name) ||
    (changed == "TargetError" && error.GetAsDouble() != preset->errorPx) ||
    (changed == "ClosingSize" && closing.GetAsInt() == PointLook::NEVER))
  {
    quality.Set("custom");
  }
}

} // namespace pointfront
