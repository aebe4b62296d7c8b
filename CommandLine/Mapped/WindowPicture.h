#pragma once

#include "pointfront/Base/Result.h"

#include <string>

class vtkRenderWindow;

namespace pointfront
{

/// Writes the window's last picture as PNG; the file is whole or absent.
Result<void> writeWindowPicture(vtkRenderWindow* window, const std::string& path);

/// Whether a pixel of the window's last picture shows a point: it has a depth.
bool showsPoints(vtkRenderWindow* window);

} // namespace pointfront
