#pragma once

#include "pointfront/Base/Result.h"

#include <string>

class vtkRenderWindow;

namespace pointfront
{

/// Writes the window's last picture as PNG; the file is whole or absent.
Result<void> writeWindowPicture(vtkRenderWindow* window, const std::string& path);

} // namespace pointfront
