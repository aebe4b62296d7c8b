#pragma once

#include "pointfront/Base/Result.h"

#include <string>

class vtkRenderWindow;

namespace pointfront
{

/// What the window drew last, as PNG; whole or absent.
Result<void> writeWindowPicture(vtkRenderWindow* window, const std::string& path);

} // namespace pointfront
