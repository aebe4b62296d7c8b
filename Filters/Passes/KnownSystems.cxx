#include "KnownSystems.h"

#include "ProjCoordinateSystems.h"
#include "ProjectedSink.h"
#include "ProjectionPass.h"

namespace pointfront
{

std::shared_ptr<const CoordinateSystems> knownSystems()
{
  return std::make_shared<ProjCoordinateSystems>();
}

Result<std::unique_ptr<AttributePass>> oneSystemPass(
  const std::string& target, const std::string& assumed)
{
  return std::unique_ptr<AttributePass>(
    std::make_unique<ProjectionPass>(ProjectionOptions{ target, assumed }));
}

Result<std::unique_ptr<PointSink>> sinkInSystem(
  std::unique_ptr<PointSink> sink, const std::string& target)
{
  return std::unique_ptr<PointSink>(std::make_unique<ProjectedSink>(std::move(sink), target));
}

} // namespace pointfront
