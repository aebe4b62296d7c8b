#include "vtkPointFrontExtractSelectedPoints.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPointFrontExtractSelectedPoints);

//------------------------------------------------------------------------------
vtkPointFrontExtractSelectedPoints::vtkPointFrontExtractSelectedPoints()
{
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkPointFrontExtractSelectedPoints::~vtkPointFrontExtractSelectedPoints() = default;

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelectedPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
