// usage: pointfrontPCLPoints FILE.pcd: x, y, z and intensity of each point, as PCL's typed reader
// gives them.

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cstdio>

int main(int argc, char** argv)
{
  pcl::PointCloud<pcl::PointXYZ> places;
  pcl::PointCloud<pcl::PointXYZI> points;
  if (argc != 2 || pcl::io::loadPCDFile(argv[1], places) != 0 ||
    pcl::io::loadPCDFile(argv[1], points) != 0 || places.size() != points.size())
  {
    return 1;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    std::printf("%.9g %.9g %.9g %.9g\n", static_cast<double>(places[i].x),
      static_cast<double>(places[i].y), static_cast<double>(places[i].z),
      static_cast<double>(points[i].intensity));
  }
  return 0;
}
