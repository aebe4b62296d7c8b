// usage: pointfrontReferencePicture IN.las CAMERA.json WIDTH HEIGHT POINTSIZE OUT.png
//
// Draws all points of a LAS or LAZ file from memory with VTK's own vtkPolyDataMapper, in their RGB,
// unlit, on black, without multisampling: what the tool's picture must equal when its error is
// small enough to draw everything. 16 bit colours are shown by their high byte, unless the whole
// file has none above 255: then they are 8 bit colours in wide fields.

#include "LASFormat.h"

#include <nlohmann/json.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

namespace
{

using namespace pointfront;

[[noreturn]] void fail(const std::string& text)
{
  std::fprintf(stderr, "%s\n", text.c_str());
  std::exit(1);
}

/// Three values a point, as the file has them.
void appendColours(
  const Attribute& rgb, const std::vector<std::byte>& column, std::vector<std::uint16_t>& colours)
{
  const std::size_t before = colours.size();
  colours.resize(before + column.size() / sizeOf(rgb.type));
  if (rgb.type == ScalarType::UInt16)
  {
    std::memcpy(colours.data() + before, column.data(), column.size());
    return;
  }
  for (std::size_t i = 0; i < column.size(); ++i)
  {
    colours[before + i] = std::to_integer<std::uint16_t>(column[i]);
  }
}

vtkSmartPointer<vtkUnsignedCharArray> shownColours(const std::vector<std::uint16_t>& colours)
{
  const bool wide =
    std::any_of(colours.begin(), colours.end(), [](std::uint16_t value) { return value > 255; });
  auto shown = vtkSmartPointer<vtkUnsignedCharArray>::New();
  shown->SetNumberOfComponents(3);
  for (const std::uint16_t value : colours)
  {
    shown->InsertNextValue(static_cast<unsigned char>(wide ? value >> 8 : value));
  }
  return shown;
}

vtkSmartPointer<vtkPolyData> readAll(const std::string& path)
{
  Result<std::unique_ptr<PointSource>> source = LASFormat().open(path);
  if (!source)
  {
    fail(source.error().what);
  }
  const AttributeSchema& schema = (*source)->description().schema;
  const std::optional<std::size_t> rgb = schema.find("rgb");
  if (!rgb)
  {
    fail(path + ": has no rgb");
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<std::uint16_t> colours;
  vtkNew<vtkCellArray> vertices;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
  {
    if (Result<void> read = (*source)->read(chunk, batch); !read)
    {
      fail(read.error().what);
    }
    for (const glm::dvec3& p : batch.positions)
    {
      const vtkIdType id = points->InsertNextPoint(p.x, p.y, p.z);
      vertices->InsertNextCell(1, &id);
    }
    appendColours(schema[*rgb], batch.columns[*rgb], colours);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(shownColours(colours));
  return data;
}

void placeCamera(const std::string& path, vtkCamera* camera)
{
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(path));
  const auto& position = json.at("position");
  const auto& focal = json.at("focal_point");
  const auto& up = json.at("view_up");
  camera->SetPosition(position.at(0), position.at(1), position.at(2));
  camera->SetFocalPoint(focal.at(0), focal.at(1), focal.at(2));
  camera->SetViewUp(up.at(0), up.at(1), up.at(2));
  camera->SetViewAngle(json.at("view_angle"));
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 7)
  {
    fail("usage: pointfrontReferencePicture IN.las CAMERA.json WIDTH HEIGHT POINTSIZE OUT.png");
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(readAll(argv[1]));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetPointSize(std::stof(argv[5]));
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.0, 0.0, 0.0);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(std::stoi(argv[3]), std::stoi(argv[4]));
  window->AddRenderer(renderer);
  placeCamera(argv[2], renderer->GetActiveCamera());
  renderer->ResetCameraClippingRange();
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> png;
  png->SetInputConnection(image->GetOutputPort());
  png->SetFileName(argv[6]);
  png->Write();
  return png->GetErrorCode() == 0 ? 0 : 1;
}
