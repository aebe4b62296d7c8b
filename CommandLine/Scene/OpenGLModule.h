#pragma once

#include "StoreScene.h"

#include <memory>

namespace pointfront
{

/// The library that draws through VTK and OpenGL. It is loaded when somebody asks for that back end
/// and not before: no other picture needs VTK, X or a GL, and a tool that was built without them is
/// the same program.
class OpenGLModule
{
public:
  /// Errors  of the scene; Unsupported: the library is not installed beside this program.
  static Result<std::unique_ptr<StoreScene>> open(const DrawingOptions& options);
};

} // namespace pointfront
