#include "vtkPVPointFrontExtract.h"

#include "RegionPlanes.h"
#include "StoreFacts.h"
#include "UpstreamReader.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkDataArraySelection.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkPlanes.h"
#include "vtkPointFrontStore.h"
#include "vtkPolyData.h"
#include "vtkPVBox.h"
#include "vtkSelection.h"
#include "vtkSphere.h"

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkPVPointFrontExtract);

namespace
{

/// The number that comes a few steps of a double after `value`, away from the inside of a box. A
/// box is a place and lengths, whose sum is rounded; a box around a whole cloud keeps its last
/// points so. At 1e7 m the steps are 10 nm.
double beyond(double value, double direction)
{
  for (int step = 0; step < 4; ++step)
  {
    value = std::nextafter(value, direction);
  }
  return value;
}

/// A box as its ends, if it is not turned.
bool endsOf(vtkImplicitFunction* region, double bounds[6])
{
  auto* box = vtkPVBox::SafeDownCast(region);
  if (!box || box->GetUseReferenceBounds())
  {
    return false;
  }
  const double* turn = box->GetRotation();
  for (int i = 0; i < 3; ++i)
  {
    const double ends[2] = { box->GetPosition()[i], box->GetPosition()[i] + box->GetScale()[i] };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    bounds[2 * i] = beyond(std::min(ends[0], ends[1]), -infinity);
    bounds[2 * i + 1] = beyond(std::max(ends[0], ends[1]), infinity);
  }
  return turn[0] == 0.0 && turn[1] == 0.0 && turn[2] == 0.0;
}

void addCount(vtkPolyData* data, const char* name, vtkIdType count)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->InsertNextValue(count);
  data->GetFieldData()->AddArray(array);
}

} // namespace

//------------------------------------------------------------------------------
vtkPVPointFrontExtract::vtkPVPointFrontExtract()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkPVPointFrontExtract::~vtkPVPointFrontExtract() = default;

//------------------------------------------------------------------------------
void vtkPVPointFrontExtract::SetRegion(vtkImplicitFunction* region)
{
  if (this->Region != region)
  {
    this->Region = region;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFrontExtract::SetSelectionConnection(vtkAlgorithmOutput* selection)
{
  this->SetInputConnection(1, selection);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkPVPointFrontExtract::GetMTime()
{
  // Not the superclass's settings that RequestData() makes of these.
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Region ? std::max(time, this->Region->GetMTime()) : time;
}

//------------------------------------------------------------------------------
int vtkPVPointFrontExtract::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkSelection");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVPointFrontExtract::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPointFrontReader* reader = pointfront::upstreamReaderOf(this);
  vtkPointFrontStore* store = reader ? reader->GetStore() : nullptr;
  for (int i = 0; store && i < store->GetNumberOfAttributes(); ++i)
  {
    const bool computed = store->GetStore()->description().isComputed(static_cast<std::size_t>(i));
    this->PointDataArraySelection->AddArray(store->GetAttributeName(i), !computed);
  }
  return this->Superclass::RequestInformation(request, inputs, outputs);
}

//------------------------------------------------------------------------------
bool vtkPVPointFrontExtract::ChooseRegion(vtkSelection* selection)
{
  // The settings of the superclass are made anew for each update; they are no changes of a user's.
  vtkPlane* plane = vtkPlane::SafeDownCast(this->Region);
  vtkBox* box = vtkBox::SafeDownCast(this->Region);
  vtkSphere* sphere = vtkSphere::SafeDownCast(this->Region);
  this->UseBox = this->UseRegion && endsOf(this->Region, this->Box);
  this->UseSphere = this->UseRegion && sphere;
  this->Frustum = nullptr;
  if (this->UseRegion && !plane && !box && !sphere)
  {
    vtkErrorMacro("the region is neither a box, nor a sphere, nor a plane: choose one, or switch "
                  "Use Region off");
    return false;
  }
  if (this->UseSphere)
  {
    std::copy_n(sphere->GetCenter(), 3, this->SphereCenter);
    this->SphereRadius = sphere->GetRadius();
  }
  else if (this->UseRegion && !this->UseBox)
  {
    this->Frustum = plane ? pointfront::planesOf(plane) : pointfront::planesOf(box);
  }
  if (!selection || selection->GetNumberOfNodes() == 0)
  {
    return true;
  }
  const double* const frustum = pointfront::frustumOf(selection);
  if (!frustum)
  {
    vtkErrorMacro("the selection names points and is no region: use Extract Selection for it, or "
                  "Select Points Through (g) for a region");
    return false;
  }
  if (this->Frustum)
  {
    vtkErrorMacro("a turned box or a plane cannot be combined with a selection: switch Use Region "
                  "off, or do without the selection");
    return false;
  }
  this->Frustum = pointfront::planesOf(frustum);
  return true;
}

//------------------------------------------------------------------------------
int vtkPVPointFrontExtract::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  int done = 0;
  if (!pointfront::upstreamReaderOf(this))
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("PointFront Extract reads from a store: its input is a PointFront Reader itself, "
                  "and no filter's output");
  }
  else if (pointfront::isPreview(pointfront::upstreamReaderOf(this)))
  {
    vtkErrorMacro(<< pointfront::previewRefusal());
  }
  else if (this->ChooseRegion(vtkSelection::GetData(inputs[1], 0)))
  {
    done = this->Superclass::RequestData(request, inputs, outputs);
  }
  if (done)
  {
    vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
    vtkPointFrontReader* reader = pointfront::upstreamReaderOf(this);
    pointfront::addStoreFrame(*reader->GetStore()->GetStore(), output);
    addCount(output, "points_chosen", this->GetNumberOfPointsChosen());
    addCount(output, "points_read", this->GetNumberOfPointsRead());
    addCount(output, "bytes_read", static_cast<vtkIdType>(this->GetNumberOfBytesRead()));
  }
  return 1; // one error says why the output is empty: no failure of the pipeline's besides
}

//------------------------------------------------------------------------------
void vtkPVPointFrontExtract::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UseRegion: " << this->UseRegion << "\n"
     << indent << "Region: " << (this->Region ? this->Region->GetClassName() : "(none)") << "\n";
}
