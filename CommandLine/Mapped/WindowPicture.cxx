#include "WindowPicture.h"

#include "PNGWriter.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

Result<void> writeWindowPicture(vtkRenderWindow* window, const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  image->Update();
  vtkImageData* const pixels = image->GetOutput();
  int size[3];
  pixels->GetDimensions(size);
  const PNGWriter::Size rows{ static_cast<std::uint32_t>(size[0]),
    static_cast<std::uint32_t>(size[1]) };
  const Result<std::unique_ptr<PNGWriter>> png =
    PNGWriter::create(path, rows, PNGWriter::Pixels::RGB8);
  if (!png)
  {
    return png.error();
  }
  const auto* const top =
    static_cast<const std::uint8_t*>(pixels->GetScalarPointer(0, size[1] - 1, 0));
  const Result<void> written =
    (*png)->append(top, rows.height, -3 * static_cast<std::ptrdiff_t>(size[0]));
  return written ? (*png)->finish() : written;
}

bool showsPoints(vtkRenderWindow* window)
{
  const int* const size = window->GetSize();
  vtkNew<vtkFloatArray> depths;
  window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depths);
  const float* const begin = depths->GetPointer(0);
  return std::any_of(
    begin, begin + depths->GetNumberOfValues(), [](float depth) { return depth < 1.0f; });
}

} // namespace pointfront
