#include "vtkPointFrontExtractSelectionRange.h"

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

vtkStandardNewMacro(vtkPointFrontExtractSelectionRange);

//------------------------------------------------------------------------------
vtkPointFrontExtractSelectionRange::vtkPointFrontExtractSelectionRange() = default;

//------------------------------------------------------------------------------
vtkPointFrontExtractSelectionRange::~vtkPointFrontExtractSelectionRange() = default;

//------------------------------------------------------------------------------
int vtkPointFrontExtractSelectionRange::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!pointfront::upstreamReaderOf(this))
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  auto* controller = vtkMultiProcessController::GetGlobalController();
  vtkNew<vtkPointFrontExtractSelection> extract;
  extract->SetInputConnection(0, this->GetInputConnection(0, 0));
  extract->SetInputConnection(1, this->GetInputConnection(1, 0));
  extract->UpdatePiece(controller ? controller->GetLocalProcessId() : 0,
    controller ? controller->GetNumberOfProcesses() : 1, 0);
  auto* points = vtkDataSet::SafeDownCast(extract->GetOutputDataObject(0));
  vtkDataArray* values =
    points && this->ArrayName ? points->GetPointData()->GetArray(this->ArrayName) : nullptr;
  // The least, and the negative of the greatest, so that one reduction finds both.
  double own[2] = { VTK_DOUBLE_MAX, VTK_DOUBLE_MAX };
  if (values && values->GetNumberOfTuples() > 0)
  {
    double range[2];
    values->GetRange(range, this->Component);
    own[0] = range[0];
    own[1] = -range[1];
  }
  double all[2];
  std::copy_n(own, 2, all);
  if (controller)
  {
    controller->AllReduce(own, all, 2, vtkCommunicator::MIN_OP);
  }
  this->Range[0] = all[0];
  this->Range[1] = -all[1]; // below the first where nothing is selected
  return 1;
}

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelectionRange::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
