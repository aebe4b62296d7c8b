#include "pointfront/Neighbourhood/KdIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace pointfront;

namespace
{

using Entries = std::vector<NeighbourList::Entry>;

/// A list to which every place was offered.
Entries amongAll(const PositionSet& set, const glm::dvec3& from, std::uint32_t wanted, int axes)
{
  NeighbourList list(wanted);
  list.begin(set);
  for (std::uint32_t i = 0; i < set.positions.size(); ++i)
  {
    const glm::dvec3 d = set.positions[i] - from;
    list.offer(d.x * d.x + d.y * d.y + (axes > 2 ? d.z * d.z : 0.0), i);
  }
  return list.entries();
}

Entries byTree(
  const KdIndex& index, const PositionSet& set, const glm::dvec3& from, std::uint32_t wanted)
{
  NeighbourList list(wanted);
  list.begin(set);
  index.search(from, list);
  return list.entries();
}

bool same(const Entries& a, const Entries& b)
{
  bool all = a.size() == b.size();
  for (std::size_t i = 0; all && i < a.size(); ++i)
  {
    all = a[i].index == b[i].index && a[i].squaredDistance == b[i].squaredDistance;
  }
  return all;
}

/// Places on a grid of steps, so that many are equally far from another one.
PositionSet gridPlaces(
  std::mt19937& random, std::size_t count, int side, double step, const glm::dvec3& corner)
{
  PositionSet set;
  std::uniform_int_distribution<int> cell(0, side);
  for (std::size_t i = 0; i < count; ++i)
  {
    set.positions.push_back(
      corner + step * glm::dvec3(cell(random), cell(random), cell(random) / 8));
  }
  std::vector<glm::dvec3>& all = set.positions; // each place once
  std::sort(all.begin(), all.end(), positionLess);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  set.counts.assign(all.size(), 1);
  return set;
}

} // namespace

TEST(KdIndex, FindsWhatALookAtAllPlacesFindsFromNearAndFromFar)
{
  std::mt19937 random(5);
  for (const double step : { 0.001, 1.0 })
  {
    for (const glm::dvec3& corner : { glm::dvec3(0.0), glm::dvec3(1e7, -3e6, 120.0) })
    {
      const PositionSet set = gridPlaces(random, 3000, 60, step, corner);
      for (const int axes : { 2, 3 })
      {
        const KdIndex index(set, axes);
        for (const double away : { 0.0, 10.0, 1e3, 1e6 })
        {
          std::uniform_real_distribution<double> within(-away - 30.0, away + 60.0);
          for (int query = 0; query < 60; ++query)
          {
            const glm::dvec3 from =
              corner + step * glm::dvec3(within(random), within(random), within(random));
            ASSERT_TRUE(same(byTree(index, set, from, 12), amongAll(set, from, 12, axes)))
              << "step " << step << ", " << axes << " axes, " << away << " steps away";
          }
        }
      }
    }
  }
}

TEST(KdIndex, PlacesOfAnyNumberAndAllAtOnePoint)
{
  const glm::dvec3 at(1e15, -1e-15, 1e300);
  for (const std::size_t count : { 0u, 1u, 12u, 13u, 500u })
  {
    PositionSet set;
    set.positions.assign(count, at);
    set.counts.assign(count, 1);
    const KdIndex index(set, 2);
    const std::size_t found = byTree(index, set, glm::dvec3(0.0), 12).size();
    EXPECT_EQ(found, std::min<std::size_t>(count, 12));
  }
}
