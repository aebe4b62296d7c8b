#include "StoreCompany.h"

#include "KnownSystems.h"

#include "pointfront/Tiles/StoredCloudFormats.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdio>

namespace pointfront
{

namespace
{
/// Length of the gap between two boxes, 0 if they touch.
double gapBetween(const Bounds& a, const Bounds& b)
{
  return glm::length(glm::max(glm::max(a.low - b.high, b.low - a.high), glm::dvec3(0.0)));
}

bool sameSystem(const std::string& one, const std::string& other)
{
  if (one == other || one.empty() || other.empty())
  {
    return true; // two systems that are not known do not differ
  }
  const std::shared_ptr<const CoordinateSystems> known = knownSystems();
  const auto a = known->parse(one);
  const auto b = known->parse(other);
  return !a || !b || known->equivalent(*a, *b, true);
}
} // namespace

std::vector<std::string> doubtsOfCompany(const std::vector<std::string>& clouds)
{
  constexpr double far = 10.0; // times the larger one's diagonal
  std::vector<std::string> doubts;
  std::vector<StoreDescription> seen;
  if (clouds.size() < 2)
  {
    return doubts;
  }
  for (const std::string& path : clouds)
  {
    if (const auto cloud = StoredCloudFormats::ofProcess().open(path))
    {
      seen.push_back((*cloud)->description());
    }
  }
  for (std::size_t i = 1; i < seen.size(); ++i)
  {
    const StoreDescription& one = seen[0];
    const StoreDescription& other = seen[i];
    if (!sameSystem(one.crsWkt, other.crsWkt))
    {
      doubts.push_back(other.path + " is in another coordinate reference system than " + one.path +
        ": they do not lie where they should; build them with one --crs");
    }
    if (one.bounds.empty() || other.bounds.empty())
    {
      continue;
    }
    double gap = gapBetween(one.bounds, other.bounds);
    double size = std::max(glm::length(one.bounds.size()), glm::length(other.bounds.size()));
    for (std::size_t k = 1; k < seen.size(); ++k) // the nearest neighbour counts
    {
      if (k != i && !seen[k].bounds.empty())
      {
        gap = std::min(gap, gapBetween(seen[k].bounds, other.bounds));
        size = std::max(size, glm::length(seen[k].bounds.size()));
      }
    }
    if (gap > far * size)
    {
      char text[160];
      std::snprintf(text, sizeof text,
        " lies %.6g units away from the others, which are at most "
        "%.6g units long: together they are small in the picture",
        gap, size);
      doubts.push_back(other.path + text);
    }
  }
  return doubts;
}

} // namespace pointfront
