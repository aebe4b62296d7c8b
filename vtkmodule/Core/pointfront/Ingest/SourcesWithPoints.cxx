#include "pointfront/Ingest/SourcesWithPoints.h"

#include <algorithm>
#include <iterator>

namespace pointfront
{

std::vector<PointSource*> allSources(const std::vector<std::unique_ptr<PointSource>>& sources)
{
  std::vector<PointSource*> all;
  std::transform(sources.begin(), sources.end(), std::back_inserter(all),
    [](const auto& source) { return source.get(); });
  return all;
}

std::vector<PointSource*> sourcesWithPoints(
  const std::vector<std::unique_ptr<PointSource>>& sources)
{
  const std::vector<PointSource*> all = allSources(sources);
  std::vector<PointSource*> filled;
  std::copy_if(all.begin(), all.end(), std::back_inserter(filled),
    [](const PointSource* source) { return source->description().pointCount > 0; });
  return filled.empty() ? all : filled;
}

} // namespace pointfront
