#include "vtkPointFrontPickingHelper.h"

#include "UpstreamReader.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointFrontExtractSelection.h"

#include <algorithm>
#include <array>
#include <limits>

vtkStandardNewMacro(vtkPointFrontPickingHelper);

//------------------------------------------------------------------------------
vtkPointFrontPickingHelper::vtkPointFrontPickingHelper() = default;

//------------------------------------------------------------------------------
vtkPointFrontPickingHelper::~vtkPointFrontPickingHelper() = default;

//------------------------------------------------------------------------------
void vtkPointFrontPickingHelper::ComputeIntersection()
{
  if (!this->Selection || !pointfront::upstreamReader(this->Input))
  {
    this->Superclass::ComputeIntersection();
    return;
  }
  auto* controller = vtkMultiProcessController::GetGlobalController();
  vtkNew<vtkPointFrontExtractSelection> extract;
  extract->SetInputConnection(0, this->Input->GetOutputPort(0));
  extract->SetInputConnection(1, this->Selection->GetOutputPort(0));
  extract->UpdatePiece(controller->GetLocalProcessId(), controller->GetNumberOfProcesses(), 0);
  auto* picked = vtkDataSet::SafeDownCast(extract->GetOutput());

  // One process has the point. Place, normal, and how many have some, in one reduction.
  std::array<double, 7> own{};
  if (picked && picked->GetNumberOfPoints() > 0)
  {
    picked->GetPoint(0, own.data());
    vtkDataArray* normals = picked->GetPointData()->GetArray("normal");
    const bool has = normals && normals->GetNumberOfComponents() == 3;
    for (int i = 0; i < 3; ++i)
    {
      own[3 + i] = has ? normals->GetComponent(0, i) : std::numeric_limits<double>::quiet_NaN();
    }
    own[6] = 1.0;
  }
  std::array<double, 7> sum{};
  controller->AllReduce(own.data(), sum.data(), 7, vtkCommunicator::SUM_OP);
  if (sum[6] == 0.0)
  {
    vtkErrorMacro("the picked point could not be read");
    sum.fill(std::numeric_limits<double>::quiet_NaN()); // no place, rather than the origin
  }
  for (int i = 0; i < 3; ++i)
  {
    this->Intersection[i] = sum[i] / std::max(sum[6], 1.0);
    this->IntersectionNormal[i] = sum[3 + i];
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontPickingHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
