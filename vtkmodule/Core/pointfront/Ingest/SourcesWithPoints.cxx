#include "pointfront/Ingest/SourcesWithPoints.h"

namespace pointfront
{

std::vector<PointSource*> sourcesWithPoints(
  const std::vector<std::unique_ptr<PointSource>>& sources)
{
  std::vector<PointSource*> all;
  std::vector<PointSource*> filled;
  for (const auto& source : sources)
  {
    all.push_back(source.get());
    if (source->description().pointCount > 0)
    {
      filled.push_back(source.get());
    }
  }
  return filled.empty() ? all : filled;
}

} // namespace pointfront
