#pragma once

#include "vtkFrustumSelector.h"

namespace pointfront
{

/// ParaView's selector of what is in a frustum, with sides in doubles: see planesOf().
class FrustumSelector : public vtkFrustumSelector
{
public:
  static FrustumSelector* New();
  vtkTypeMacro(FrustumSelector, vtkFrustumSelector);

  void Initialize(vtkSelectionNode* node) override;
};

} // namespace pointfront
