#include "BenchmarkCloud.h"

#include "vtkPointFrontStore.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace pointfront
{
namespace
{
/// 8 bit of one point's colour.
void colourOf(const Attribute& rgb, const std::byte* bytes, unsigned char* colour)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    std::uint16_t wide = 0;
    std::memcpy(&wide, bytes + c * sizeOf(rgb.type), sizeOf(rgb.type)); // little-endian
    colour[c] = static_cast<unsigned char>(rgb.type == ScalarType::UInt8 ? wide : wide >> 8);
  }
}

} // namespace

void fail(const std::string& text)
{
  std::fprintf(stderr, "%s\n", text.c_str());
  std::exit(1);
}

vtkSmartPointer<vtkPointFrontReader> openReader(const char* path)
{
  auto reader = vtkSmartPointer<vtkPointFrontReader>::New();
  reader->SetFileName(path);
  reader->SetOverviewPoints(0);
  reader->UpdateInformation();
  if (reader->GetStore() == nullptr)
  {
    fail(std::string(path) + ": cannot be opened");
  }
  reader->GetStore()->SetHostMemoryBudget(vtkTypeInt64(4) << 30);
  return reader;
}

vtkSmartPointer<vtkPolyData> allPoints(const StoredCloud& store)
{
  const StoreDescription& description = store.description();
  const std::optional<std::size_t> column = description.schema.find("rgb");
  if (!column)
  {
    fail(description.path + ": has no rgb");
  }
  const Attribute& rgb = description.schema[*column];
  const auto count = static_cast<vtkIdType>(description.pointCount);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(count);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(static_cast<int>(count));
  vtkIdType id = 0;
  for (NodeIndex node = 0; node < store.hierarchy()->nodeCount(); ++node)
  {
    const Result<NodeColumns> decoded = store.read(node, { static_cast<std::uint32_t>(*column) });
    if (!decoded)
    {
      fail(decoded.error().what);
    }
    for (std::size_t i = 0; i < decoded->size(); ++i, ++id)
    {
      const glm::dvec3 p =
        description.grid.toWorld(decoded->origin + GridPosition(decoded->positions[i]));
      points->SetPoint(id, p.x, p.y, p.z);
      colourOf(rgb, decoded->columns[0].data() + i * rgb.bytes(), colours->GetPointer(3 * id));
      vertices->InsertCellPoint(id);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(colours);
  return data;
}

} // namespace pointfront
