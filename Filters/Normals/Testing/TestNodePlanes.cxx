#include "NodePlanes.h"
#include "NormalClouds.h"

#include "IndexedLASFile.h"
#include "LASIndexing.h"
#include "LASWriter.h"

#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/InPlace/CloudWithNormals.h"

#include <algorithm>
#include <random>
#include <thread>

namespace
{
using namespace pointfront;
using namespace pointfront::test;

Positions randomSphere(std::size_t points)
{
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Positions positions;
  for (std::size_t i = 0; i < points; ++i)
  {
    positions.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  }
  return positions;
}

std::vector<PackedNormal> planesOf(const Positions& positions)
{
  std::vector<PackedNormal> normals;
  NodePlanes().compute(positions, normals);
  EXPECT_EQ(normals.size(), positions.size());
  return normals;
}

TEST(NodePlanes, AreThoseOfTheWholeCloudWhereItIsOneNode)
{
  const Positions positions = randomSphere(5000);
  EXPECT_EQ(planesOf(positions),
    normalsBy(NormalsPass(nearest(NodePlanes::usualNeighbours)), sourcesOf(positions)));
}

TEST(NodePlanes, OnASphereAreWithinADegreeAndFaceUp)
{
  const Positions positions = randomSphere(16384);
  const std::vector<PackedNormal> normals = planesOf(positions);
  EXPECT_LT(rmsDegrees(normals, positions), 1.0);
  for (const PackedNormal& normal : normals)
  {
    ASSERT_GE(normal.z, 0);
  }
}

TEST(NodePlanes, DoNotDependOnTheOrderOfThePoints)
{
  Positions positions = randomSphere(3000);
  positions.insert(positions.end(), positions.begin(), positions.begin() + 500); // twice
  const std::vector<PackedNormal> normals = planesOf(positions);
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  Positions shuffled;
  for (const std::uint32_t i : order)
  {
    shuffled.push_back(positions[i]);
  }
  const std::vector<PackedNormal> other = planesOf(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    ASSERT_EQ(other[i], normals[order[i]]);
  }
}

TEST(NodePlanes, WithoutAPlaneAreZero)
{
  EXPECT_TRUE(planesOf({}).empty());
  EXPECT_EQ(planesOf({ glm::dvec3(1.0) }), std::vector<PackedNormal>{ PackedNormal(0) });
  EXPECT_EQ(planesOf({ glm::dvec3(0.0), glm::dvec3(1.0) })[1], PackedNormal(0));
  EXPECT_EQ(planesOf(Positions(100, glm::dvec3(4e5, 5e6, 1.0)))[99], PackedNormal(0));
  Positions line;
  for (int i = 0; i < 200; ++i)
  {
    line.emplace_back(i, 2 * i, 3 * i);
  }
  EXPECT_EQ(planesOf(line)[7], PackedNormal(0));
}

// Parts have no points of each other: a normal at their border is as good as one at a node's.
TEST(NodePlanes, ANodeOfManyPointsIsCut)
{
  const Positions positions = randomSphere(3 * NodePlanes::mostPoints + 1);
  EXPECT_LT(rmsDegrees(planesOf(positions), positions), 1.0);
}

/// A made-up survey as an indexed LAS file, whose normals are computed while nodes load.
std::shared_ptr<const StoredCloud> indexedSurvey(std::uint64_t points)
{
  const std::string las = testing::TempDir() + "/node_planes.las";
  const TerrainSource source(points, 7);
  LASWriter writer(las);
  SinkDescription description;
  description.schema = source.description().schema;
  description.grid = *source.description().grid;
  description.bounds = source.description().declaredBounds;
  description.pointCount = source.description().pointCount;
  EXPECT_TRUE(writer.begin(description));
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    EXPECT_TRUE(source.read(chunk, batch) && writer.append(batch));
  }
  EXPECT_TRUE(writer.finish());
  LASIndexOptions options;
  options.leafPoints = 2000;
  options.overwrite = true;
  const auto report = indexLASFile(las, las + lasIndexSuffix, options);
  EXPECT_TRUE(report) << report.error().what;
  auto cloud = LASIndexFormat().open(las + lasIndexSuffix);
  EXPECT_TRUE(cloud) << cloud.error().what;
  return CloudWithNormals::over(*cloud, std::make_shared<const NodePlanes>());
}

/// As loader threads do: ThreadSanitizer sees what they share.
TEST(NodePlanes, AreTheSameFromAnyNumberOfLoaders)
{
  const auto cloud = indexedSurvey(40000);
  const auto column = static_cast<std::uint32_t>(*cloud->description().schema.find("normal"));
  const NodeIndex nodes = cloud->hierarchy()->nodeCount();
  ASSERT_GT(nodes, 20u);
  std::vector<std::vector<std::byte>> alone;
  for (NodeIndex node = 0; node < nodes; ++node)
  {
    const auto read = cloud->read(node, { column });
    ASSERT_TRUE(read) << read.error().what;
    alone.push_back(read->columns[0]);
  }
  std::vector<std::thread> loaders;
  std::atomic<int> wrong{ 0 };
  for (unsigned t = 0; t < 4; ++t)
  {
    loaders.emplace_back(
      [&, t]
      {
        for (NodeIndex i = 0; i < nodes; ++i)
        {
          const NodeIndex node = (i * 7 + t * 5) % nodes; // others, and the same, at a time
          const auto read = cloud->read(node, { column });
          wrong += read && read->columns[0] == alone[node] ? 0 : 1;
        }
      });
  }
  for (std::thread& loader : loaders)
  {
    loader.join();
  }
  EXPECT_EQ(wrong, 0);
}
} // namespace
