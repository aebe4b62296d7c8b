#include "BytesAsFile.h"

#include "CameraPath.h"

#include <cmath>

namespace
{
using namespace pointfront;

void requireFinite(const Camera& camera)
{
  const double sum = std::abs(camera.viewAngleDegrees) + std::abs(camera.parallelScale.value_or(0));
  bool finite = std::isfinite(sum);
  for (int axis = 0; axis < 3; ++axis)
  {
    finite = finite && std::isfinite(camera.position[axis]) &&
      std::isfinite(camera.focalPoint[axis]) && std::isfinite(camera.viewUp[axis]);
  }
  fuzz::require(finite, "cameras have finite numbers");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const fuzz::BytesAsFile file(data, size);
  if (const Result<Camera> camera = readCameraFile(file.path()); camera)
  {
    requireFinite(*camera);
  }
  else
  {
    fuzz::require(!camera.error().what.empty(), "an Error says what happened");
  }
  constexpr int frames = 20;
  if (const Result<CameraPath> path = readPathFile(file.path(), frames); path)
  {
    for (const Camera& camera : *path)
    {
      requireFinite(camera);
    }
  }
  return 0;
}
