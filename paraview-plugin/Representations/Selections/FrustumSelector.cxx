#include "FrustumSelector.h"

#include "RegionPlanes.h"

#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"
#include "vtkPlanes.h"
#include "vtkSelectionNode.h"

namespace pointfront
{

FrustumSelector* FrustumSelector::New()
{
  VTK_STANDARD_NEW_BODY(FrustumSelector);
}

void FrustumSelector::Initialize(vtkSelectionNode* node)
{
  this->Superclass::Initialize(node);
  auto* const corners = node ? vtkDoubleArray::SafeDownCast(node->GetSelectionList()) : nullptr;
  if (corners && corners->GetNumberOfValues() == 32)
  {
    this->SetFrustum(planesOf(corners->GetPointer(0)));
  }
}

} // namespace pointfront
