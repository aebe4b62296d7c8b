#pragma once

#include "StoreScene.h"

#include <memory>

namespace pointfront
{

/// The library that draws pictures through VTK and OpenGL (see moduleSymbol()).
class OpenGLModule
{
public:
  /// Errors  of the scene; Unsupported: the library is not installed beside this program.
  static Result<std::unique_ptr<StoreScene>> open(const DrawingOptions& options);
};

} // namespace pointfront
