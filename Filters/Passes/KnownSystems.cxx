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

Result<std::unique_ptr<AttributePass>> oneSystemPass(const PassChoice& choice)
{
  ProjectionOptions options;
  options.target = choice.targetCrs;
  options.assumed = choice.assumedCrs;
  options.targetName = choice.targetCrsName;
  options.assumedName = choice.assumedCrsName;
  options.inputsMayName = choice.inputsMayNameCrs;
  return std::unique_ptr<AttributePass>(std::make_unique<ProjectionPass>(std::move(options)));
}

Result<std::unique_ptr<PointSink>> sinkInSystem(
  std::unique_ptr<PointSink> sink, const std::string& target, const std::string& assumedName)
{
  return std::unique_ptr<PointSink>(
    std::make_unique<ProjectedSink>(std::move(sink), target, assumedName));
}

} // namespace pointfront
