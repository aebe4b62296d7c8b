#include "vtkPVPointFrontReader.h"

#include "StoreFacts.h"

#include "vtkObjectFactory.h"
#include "vtkPointFrontStore.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkPVPointFrontReader);

//------------------------------------------------------------------------------
vtkPVPointFrontReader::vtkPVPointFrontReader() = default;

//------------------------------------------------------------------------------
vtkPVPointFrontReader::~vtkPVPointFrontReader() = default;

//------------------------------------------------------------------------------
int vtkPVPointFrontReader::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Superclass::RequestInformation(request, inputs, outputs);
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVPointFrontReader::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int done = this->Superclass::RequestData(request, inputs, outputs);
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  // An aborted update leaves the output empty.
  if (done && this->GetStore() && !vtkPointFrontStore::GetStoreName(output).empty())
  {
    const pointfront::StoredCloud& store = *this->GetStore()->GetStore();
    pointfront::addStoreFacts(store, this->GetOverviewPoints(), output);
    pointfront::setStoreRanges(store, output);
  }
  return 1;
}

//------------------------------------------------------------------------------
const char* vtkPVPointFrontReader::GetStoreFacts()
{
  vtkPointFrontStore* store = this->GetStore();
  this->StoreFacts =
    store ? pointfront::storeFacts(*store->GetStore(), this->GetOverviewPoints()) : std::string();
  return this->StoreFacts.c_str();
}

//------------------------------------------------------------------------------
const char* vtkPVPointFrontReader::GetTraffic()
{
  this->Traffic = pointfront::trafficText(pointfront::ByteTraffic::ofProcess().counts(), 0);
  return this->Traffic.c_str();
}

//------------------------------------------------------------------------------
void vtkPVPointFrontReader::CloseStore()
{
  this->Store = nullptr;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkPVPointFrontReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
