#include "pointfront/Query/MissedRegion.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <memory>
#include <sstream>

namespace pointfront
{

std::optional<std::string> missedRegion(const StoreDescription& store, const PointQuery& query)
{
  const Bounds& cloud = store.bounds;
  const auto misses = [&cloud](const std::shared_ptr<const Region>& region)
  { return !region->bounds().overlaps(cloud) || region->overlap(cloud) == Overlap::Outside; };
  if (cloud.empty() || std::none_of(query.regions.begin(), query.regions.end(), misses))
  {
    return std::nullopt;
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(10) << "the region lies beside the cloud, so there are no points: the "
       << "cloud has coordinates from (" << cloud.low.x << ", " << cloud.low.y << ", "
       << cloud.low.z << ") to (" << cloud.high.x << ", " << cloud.high.y << ", " << cloud.high.z
       << ")";
  return text.str();
}

} // namespace pointfront
