#include "NormalClouds.h"

#include "NormalsPass.h"

#include "LASFormat.h"

#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

namespace
{
using namespace pointfront;
using namespace pointfront::test;

/// Normals of pcl::NormalEstimation by the k nearest points, in float relative to the first point.
Positions normalsByPCL(const Positions& positions, int neighbours)
{
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const glm::dvec3& p : positions)
  {
    const glm::vec3 q(p - positions[0]);
    cloud->push_back({ q.x, q.y, q.z });
  }
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(neighbours);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  Positions result;
  for (const pcl::Normal& n : normals)
  {
    result.emplace_back(n.normal_x, n.normal_y, n.normal_z);
  }
  return result;
}

Positions lasPositions(const std::string& name)
{
  const auto source = LASFormat().open(std::string(POINTFRONT_SHARED_DATA) + "/normals/" + name);
  EXPECT_TRUE(source) << (source ? "" : source.error().what);
  Positions positions;
  PointBatch batch;
  for (std::uint64_t chunk = 0; source && chunk < (*source)->chunkCount(); ++chunk)
  {
    EXPECT_TRUE((*source)->read(chunk, batch));
    positions.insert(positions.end(), batch.positions.begin(), batch.positions.end());
  }
  return positions;
}

TEST(NormalsPass, AsPCLFindsThem)
{
  for (const Positions& positions : { bunny(), lasPositions("street_thinned.las") })
  {
    const auto ours = normalsBy(NormalsPass(nearest(16)), sourcesOf(positions));
    EXPECT_LT(rmsDegrees(ours, normalsByPCL(positions, 16)), 0.5);
  }
}

TEST(NormalsPass, ByPCLAreThoseOfItsEstimation)
{
  for (const Positions& positions : { bunny(), lasPositions("street_thinned.las") })
  {
    NormalsOptions options = nearest(16);
    options.byPCL = true;
    const auto ours = normalsBy(NormalsPass(options), sourcesOf(positions));
    ASSERT_EQ(ours.size(), positions.size());
    EXPECT_LT(rmsDegrees(ours, normalsByPCL(positions, 16)), 0.5);
  }
}

TEST(NormalsPass, ByPCLFarFromTheOriginAreAsGoodAsNear)
{
  Positions moved = bunny();
  for (glm::dvec3& p : moved)
  {
    p += glm::dvec3(524288.0, 4194304.0, 128.0); // powers of two: the digits stay
  }
  NormalsOptions options = nearest(16);
  options.byPCL = true;
  options.splatRadius = false;
  const auto near = normalsBy(NormalsPass(options), sourcesOf(bunny()));
  EXPECT_LT(rmsDegrees(normalsBy(NormalsPass(options), sourcesOf(moved)), near), 0.1);
}

} // namespace
