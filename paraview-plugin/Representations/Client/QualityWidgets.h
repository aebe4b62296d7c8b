#pragma once

#include <string>

class vtkSMProxy;

namespace pointfront
{

/// Lets Quality and the properties that it stands for say the same, after property `changed` of a
/// Point Front representation got a value: a preset or a number sets Technique, Target Error and
/// Close the Surface; another value of one of these sets Quality to custom. QualityChosen says what
/// a number stands for. Client only.
void agreeOnQuality(vtkSMProxy* representation, const std::string& changed);

} // namespace pointfront
