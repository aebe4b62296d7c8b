#include "StoreScene.h"

#include "OpenGLModule.h"
#include "SoftwareScene.h"

namespace pointfront
{

Result<std::unique_ptr<StoreScene>> StoreScene::open(const DrawingOptions& options)
{
  if (options.backend == DrawingBackend::OpenGL)
  {
    return OpenGLModule::open(options);
  }
  Result<std::unique_ptr<SoftwareScene>> scene = SoftwareScene::open(options);
  if (!scene)
  {
    return scene.error();
  }
  return std::unique_ptr<StoreScene>(std::move(scene).value());
}

} // namespace pointfront
