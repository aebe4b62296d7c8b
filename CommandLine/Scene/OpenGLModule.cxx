#include "OpenGLModule.h"

#include "OpenGLScene.h"

#include <dlfcn.h>

#include <string>

namespace pointfront
{

Result<std::unique_ptr<StoreScene>> OpenGLModule::open(const DrawingOptions& options)
{
  void* library = ::dlopen(POINTFRONT_OPENGL_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* symbol = library != nullptr ? ::dlsym(library, "pointfrontOpenOpenGLScene") : nullptr;
  if (symbol == nullptr)
  {
    const char* reason = ::dlerror();
    return makeError(Error::Kind::Unsupported,
      std::string("--backend opengl needs a library that is not here (a build without VTK has "
                  "none); use --backend software: ") +
        (reason != nullptr ? reason : POINTFRONT_OPENGL_MODULE));
  }
  Result<std::unique_ptr<StoreScene>> scene = makeError(Error::Kind::Unsupported, "");
  reinterpret_cast<decltype(&pointfrontOpenOpenGLScene)>(symbol)(options, scene);
  return scene;
}

} // namespace pointfront
