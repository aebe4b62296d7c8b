#pragma once

#include <vtkDataObject.h>
#include <vtkHardwareSelector.h>
#include <vtkMapper.h>
#include <vtkRenderer.h>

namespace pointfront
{

/// vtkOpenGLPolyDataMapper adds it to the coincident offset of points in selections.
constexpr float selectionOffset = -2.0f;

inline bool selectsPoints(vtkRenderer* renderer)
{
  vtkHardwareSelector* const selector = renderer->GetSelector();
  return selector && selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS;
}

/// Gives a mapper that draws for another one the offset of the other's points.
inline void copyPointOffset(vtkMapper* from, vtkMapper* to)
{
  double has = 0.0;
  double wanted = 0.0;
  to->GetRelativeCoincidentTopologyPointOffsetParameter(has);
  from->GetRelativeCoincidentTopologyPointOffsetParameter(wanted);
  if (has != wanted)
  {
    to->SetRelativeCoincidentTopologyPointOffsetParameter(wanted);
  }
}

} // namespace pointfront
