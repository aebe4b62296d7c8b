#include "vtkPVPointFrontReader.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontStore.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPVPointFrontReader);

namespace
{

void addTexts(vtkPolyData* data, const char* name, const std::vector<std::string>& texts)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  data->GetFieldData()->AddArray(array);
}

void addNumbers(vtkPolyData* data, const char* name, const std::vector<vtkIdType>& numbers)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  for (const vtkIdType number : numbers)
  {
    array->InsertNextValue(number);
  }
  data->GetFieldData()->AddArray(array);
}

void describe(const pointfront::StoredCloud& store, vtkIdType mostOverviewPoints, vtkPolyData* data)
{
  const pointfront::StoreDescription& about = store.description();
  const auto points = static_cast<vtkIdType>(about.pointCount);
  addNumbers(data, "store_points", { points });
  vtkNew<vtkDoubleArray> bounds;
  bounds->SetName("store_bounds");
  bounds->SetNumberOfComponents(6);
  const pointfront::Bounds& box = about.bounds;
  const double ends[6] = { box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z };
  bounds->InsertNextTuple(ends);
  data->GetFieldData()->AddArray(bounds);
  addTexts(data, "store_crs", { about.crsWkt.empty() ? "not stated" : about.crsWkt });
  addTexts(data, "store_structure",
    { about.structure + ", " + std::to_string(store.hierarchy()->nodeCount()) + " nodes, " +
      std::to_string(about.levels) + " levels, " + std::to_string(about.fileBytes) + " bytes" });
  std::vector<std::string> names;
  std::vector<vtkIdType> counts;
  for (const pointfront::Layer& layer : about.layers)
  {
    names.push_back(layer.name);
    counts.push_back(static_cast<vtkIdType>(layer.pointCount));
  }
  addTexts(data, "store_classes", names);
  addNumbers(data, "store_class_points", counts);
  const std::string shown = std::to_string(std::min(points, mostOverviewPoints));
  addTexts(data, "output_is",
    { points <= mostOverviewPoints
        ? "all points of the store"
        : "an overview of at most " + shown + " of " + std::to_string(points) +
          " points. Save Data saves this overview. The filter PointFront Extract gives the exact "
          "points, and what it gives can be saved." });
}

} // namespace

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
    describe(*this->GetStore()->GetStore(), this->GetOverviewPoints(), output);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkPVPointFrontReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
