#include "WindowPicture.h"

#include "WholeFile.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cstddef>

namespace pointfront
{

Result<void> writeWindowPicture(vtkRenderWindow* window, const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> png;
  png->SetInputConnection(image->GetOutputPort());
  png->WriteToMemoryOn();
  png->Write();
  vtkUnsignedCharArray* const bytes = png->GetResult();
  return writeWholeFile(
    path, bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()));
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
