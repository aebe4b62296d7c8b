#include "pointfront/Neighbourhood/KdIndex.h"
#include "pointfront/Neighbourhood/NeighbourCluster.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using namespace pointfront;

/// Dense and sparse places, a grid full of ties, several points at some places.
PositionSet unevenPlaces(const glm::dvec3& origin)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  PositionSet set;
  for (int i = 0; i < 3000; ++i)
  {
    const double spread = i % 3 == 0 ? 1.0 : 40.0;
    set.positions.push_back(origin +
      (i % 5 == 0 ? glm::dvec3(i % 30, i / 30 % 30, i / 900)
                  : spread * glm::dvec3(uniform(random), uniform(random), uniform(random))));
    set.counts.push_back(static_cast<std::uint32_t>(1 + random() % 3));
  }
  return set;
}

/// Places in any order: those of the list, if they can be told apart from the others.
bool expectThePlacesOfTheList(NeighbourCluster& cluster, const PositionSet& set,
  const glm::dvec3& from, const NeighbourList& list)
{
  std::vector<std::uint32_t> places;
  double squaredReach = 0.0;
  if (!cluster.searchUnordered(from, places, squaredReach))
  {
    return false;
  }
  std::vector<std::uint32_t> expected;
  for (const NeighbourList::Entry& entry : list.entries())
  {
    expected.push_back(entry.index);
    EXPECT_EQ(set.counts[entry.index], 1u);
  }
  std::sort(places.begin(), places.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(places, expected);
  EXPECT_GE(squaredReach, list.entries().back().squaredDistance);
  EXPECT_LE(squaredReach, list.entries().back().squaredDistance * 1.01 + 1e-9);
  return true;
}

/// Each list of a cluster is, entry by entry, that of a search of its own.
void expectTheListsOfTheIndex(
  const PositionSet& set, const NeighbourSearch& search, double size, const glm::dvec3& origin)
{
  const KdIndex index(set, static_cast<int>(search.axes));
  NeighbourCluster cluster(set, index, search);
  NeighbourList expected(search.neighbours);
  NeighbourList list(search.neighbours);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int c = 0; c < 40; ++c)
  {
    const glm::dvec3 middle = set.positions[random() % set.positions.size()];
    cluster.gather(middle, size * std::sqrt(3.0));
    const glm::dvec3 part = c % 2 == 0 ? middle : middle + 0.5 * size * glm::dvec3(1.0, 0.0, -1.0);
    const double partSize = c % 4 == 0 ? size : 0.5 * size;
    if (c % 4 != 3)
    {
      cluster.focus(part, partSize * std::sqrt(3.0));
    }
    for (int i = 0; i < 10; ++i)
    {
      const glm::dvec3 from =
        part + partSize * glm::dvec3(uniform(random), uniform(random), uniform(random));
      expected.begin(set,
        search.neighbours > 0 ? std::numeric_limits<double>::infinity()
                              : search.radius * search.radius);
      index.search(from, expected);
      cluster.search(from, list);
      auto a = expected.entries();
      auto b = list.entries();
      ASSERT_EQ(a.size(), b.size()) << origin.x << " " << size;
      if (search.neighbours == 0) // in any order
      {
        const auto less = [](const NeighbourList::Entry& l, const NeighbourList::Entry& r)
        { return l.index < r.index; };
        std::sort(a.begin(), a.end(), less);
        std::sort(b.begin(), b.end(), less);
      }
      for (std::size_t n = 0; n < a.size(); ++n)
      {
        EXPECT_EQ(a[n].squaredDistance, b[n].squaredDistance);
        EXPECT_EQ(set.positions[a[n].index], set.positions[b[n].index]);
      }
      expectThePlacesOfTheList(cluster, set, from, expected);
    }
  }
}

TEST(NeighbourCluster, GivesTheListsOfTheIndex)
{
  for (const glm::dvec3& origin : { glm::dvec3(0.0), glm::dvec3(1e7, -1e7, 1e7) })
  {
    const PositionSet set = unevenPlaces(origin);
    for (const double size : { 0.0, 0.3, 5.0, 100.0 })
    {
      expectTheListsOfTheIndex(set, { 16, 0.0, 3 }, size, origin);
      expectTheListsOfTheIndex(set, { 1, 0.0, 3 }, size, origin);
      expectTheListsOfTheIndex(set, { 300, 0.0, 3 }, size, origin);
      expectTheListsOfTheIndex(set, { 12, 0.0, 2 }, size, origin);
      expectTheListsOfTheIndex(set, { 0, 2.5, 3 }, size, origin);
      expectTheListsOfTheIndex(set, { 0, 2.5, 2 }, size, origin);
    }
  }
}

TEST(NeighbourCluster, MostPointsNeedNoOrder)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 100.0);
  PositionSet set;
  for (int i = 0; i < 10000; ++i)
  {
    const glm::dvec3 p(uniform(random), uniform(random), 0.0);
    set.positions.push_back(glm::dvec3(1e7, 1e7, 50.0) + glm::round(p * 1e3) / 1e3);
    set.counts.push_back(1);
  }
  const KdIndex index(set, 3);
  NeighbourCluster cluster(set, index, { 16, 0.0, 3 });
  NeighbourList list(16);
  int unordered = 0;
  for (int c = 0; c < 100; ++c)
  {
    const glm::dvec3 middle = set.positions[random() % set.positions.size()];
    cluster.gather(middle, 3.0);
    cluster.focus(middle, 2.0);
    for (int i = 0; i < 10; ++i)
    {
      const glm::dvec3 from = middle + 0.02 * glm::dvec3(uniform(random), -uniform(random), 0.0) -
        glm::dvec3(1.0, -1.0, 0.0);
      list.begin(set);
      index.search(from, list);
      unordered += expectThePlacesOfTheList(cluster, set, from, list) ? 1 : 0;
    }
  }
  EXPECT_GT(unordered, 900);
}

TEST(NeighbourCluster, OfFewerPlacesThanAreWantedGivesAll)
{
  PositionSet set;
  for (int i = 0; i < 5; ++i)
  {
    set.positions.emplace_back(std::pow(1e3, i), 0.0, 0.0);
    set.counts.push_back(1);
  }
  expectTheListsOfTheIndex(set, { 16, 0.0, 3 }, 1.0, glm::dvec3(0.0));
  const PositionSet none;
  const KdIndex index(none, 3);
  NeighbourCluster cluster(none, index, { 16, 0.0, 3 });
  NeighbourList list(16);
  cluster.gather(glm::dvec3(1.0), 2.0);
  cluster.search(glm::dvec3(1.0), list);
  EXPECT_TRUE(list.entries().empty());
}
} // namespace
