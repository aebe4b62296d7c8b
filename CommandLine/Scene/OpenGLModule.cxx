#include "OpenGLModule.h"

#include "ModuleSymbol.h"
#include "OpenGLScene.h"

namespace pointfront
{

Result<std::unique_ptr<StoreScene>> OpenGLModule::open(const DrawingOptions& options)
{
  const Result<void*> symbol = moduleSymbol(POINTFRONT_OPENGL_MODULE, "pointfrontOpenOpenGLScene",
    "--backend opengl needs a library that is not here (a build without VTK has none); use "
    "--backend software");
  if (!symbol)
  {
    return symbol.error();
  }
  Result<std::unique_ptr<StoreScene>> scene = makeError(Error::Kind::Unsupported, "");
  reinterpret_cast<decltype(&pointfrontOpenOpenGLScene)> (*symbol)(options, scene);
  return scene;
}

} // namespace pointfront
