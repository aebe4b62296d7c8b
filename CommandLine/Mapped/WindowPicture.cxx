#include "WindowPicture.h"

#include "WholeFile.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

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

} // namespace pointfront
