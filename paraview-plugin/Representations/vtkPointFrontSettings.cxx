#include "vtkPointFrontSettings.h"

#include "vtkObjectFactory.h"
#include "vtkPointFrontStore.h"

#include <algorithm>

vtkStandardNewMacro(vtkPointFrontSettings);

namespace
{
vtkIdType mostSelectionPoints = 50000000; // some GB
} // namespace

//------------------------------------------------------------------------------
vtkPointFrontSettings::vtkPointFrontSettings() = default;

//------------------------------------------------------------------------------
vtkPointFrontSettings::~vtkPointFrontSettings() = default;

//------------------------------------------------------------------------------
void vtkPointFrontSettings::SetHostMemoryBudget(int mebibytes)
{
  const vtkTypeInt64 bytes = static_cast<vtkTypeInt64>(std::max(mebibytes, 1)) << 20;
  const bool changed = bytes != vtkPointFrontStore::GetProcessMemoryBudget();
  vtkPointFrontStore::SetProcessMemoryBudget(bytes); // also the default: no store may raise it
  if (changed)
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkPointFrontSettings::GetHostMemoryBudget()
{
  return static_cast<int>(vtkPointFrontStore::GetProcessMemoryBudget() >> 20);
}

//------------------------------------------------------------------------------
void vtkPointFrontSettings::SetMostSelectionPoints(vtkIdType points)
{
  const vtkIdType most = std::max<vtkIdType>(points, 1);
  if (most != mostSelectionPoints)
  {
    mostSelectionPoints = most;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontSettings::GetMostSelectionPoints()
{
  return mostSelectionPoints;
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontSettings::MostSelectionPoints()
{
  return mostSelectionPoints;
}

//------------------------------------------------------------------------------
void vtkPointFrontSettings::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HostMemoryBudget: " << this->GetHostMemoryBudget() << " MiB\n";
  os << indent << "MostSelectionPoints: " << mostSelectionPoints << "\n";
}
