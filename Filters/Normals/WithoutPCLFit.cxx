#include "PCLFit.h"

namespace pointfront
{

bool hasPCLFit()
{
  return false;
}

std::optional<SurfaceFit> fitSurfaceByPCL(const glm::dvec3&, const std::vector<NearPoint>&)
{
  return std::nullopt;
}

} // namespace pointfront
