#include "QualityWidgets.h"

#include "PointLook.h"

#include "pointfront/Quality/QualityChoice.h"
#include "pointfront/Style/TechniqueNames.h"

#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

namespace pointfront
{

void agreeOnQuality(vtkSMProxy* representation, const std::string& changed)
{
  vtkSMPropertyHelper quality(representation, "Quality");
  vtkSMPropertyHelper chosen(representation, "QualityChosen");
  const auto choice = chooseQuality(quality.GetAsString());
  if (changed == "Quality")
  {
    chosen.Set(choice ? choice->sentence.c_str() : "");
  }
  if (!choice)
  {
    return; // custom, or what is an error of the next frame
  }
  const QualityPreset& preset = choice->preset;
  vtkSMPropertyHelper technique(representation, "Technique");
  vtkSMPropertyHelper error(representation, "TargetError");
  vtkSMPropertyHelper closing(representation, "ClosingSize");
  const bool blended = preset.technique == Technique::Splats && preset.blended;
  const std::string name = blended ? "blended" : traitsOf(preset.technique).name;
  if (changed == "Quality")
  {
    technique.Set(name.c_str());
    error.Set(preset.errorPx);
    closing.Set(PointLook::BY_TECHNIQUE);
  }
  else if ((changed == "Technique" && technique.GetAsString() != name) ||
    (changed == "TargetError" && error.GetAsDouble() != preset.errorPx) ||
    (changed == "ClosingSize" && closing.GetAsInt() == PointLook::NEVER))
  {
    quality.Set("custom");
    chosen.Set("");
  }
}

} // namespace pointfront
