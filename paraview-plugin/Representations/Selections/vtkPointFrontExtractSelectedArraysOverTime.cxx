#include "vtkPointFrontExtractSelectedArraysOverTime.h"

#include "UpstreamReader.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontExtractSelection.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPointFrontExtractSelectedArraysOverTime);

namespace
{

/// Attributes that are not alike in all stores of a reader: VTK's filter takes the arrays of the
/// first time step for those of all.
std::vector<std::string> differingArrays(vtkPointFrontReader* reader)
{
  std::map<std::string, std::vector<pointfront::Attribute>> found;
  for (int time = 0; time < reader->GetNumberOfFileNames(); ++time)
  {
    vtkStdString error;
    const auto store = vtkPointFrontStore::Open(reader->GetFileName(time), error);
    if (store)
    {
      for (const pointfront::Attribute& attribute : store->GetStore()->description().schema)
      {
        found[attribute.name].push_back(attribute);
      }
    }
  }
  std::vector<std::string> names;
  for (const auto& [name, attributes] : found)
  {
    const bool everywhere =
      attributes.size() == static_cast<std::size_t>(reader->GetNumberOfFileNames());
    if (!everywhere ||
      std::count(attributes.begin(), attributes.end(), attributes.front()) !=
        static_cast<std::ptrdiff_t>(attributes.size()))
    {
      names.push_back(name);
    }
  }
  return names;
}

} // namespace

//------------------------------------------------------------------------------
vtkPointFrontExtractSelectedArraysOverTime::vtkPointFrontExtractSelectedArraysOverTime() = default;

//------------------------------------------------------------------------------
vtkPointFrontExtractSelectedArraysOverTime::~vtkPointFrontExtractSelectedArraysOverTime() = default;

//------------------------------------------------------------------------------
int vtkPointFrontExtractSelectedArraysOverTime::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointFrontReader* reader = pointfront::upstreamReaderOf(this);
  if (reader && reader->GetNumberOfFileNames() > 1 && !this->ReportStatisticsOnly)
  {
    vtkErrorMacro(
      "the stores of these time steps do not name their points alike, so a point has no "
      "history: tick Only Report Selection Statistics");
    return 0;
  }
  if (auto* extractor = vtkPointFrontExtractSelection::SafeDownCast(this->GetSelectionExtractor()))
  {
    extractor->SetReader(reader);
    extractor->SetDroppedArrays(reader ? differingArrays(reader) : std::vector<std::string>());
  }
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelectedArraysOverTime::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
