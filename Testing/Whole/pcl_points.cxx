// usage: pointfrontPCLPoints FILE.pcd: x, y, z, intensity and, if the file has colours, r, g, b of
// each point, as PCL's typed readers give them.

#include <pcl/common/io.h>
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
  pcl::PCLPointCloud2 fields;
  pcl::PointCloud<pcl::PointXYZRGB> colours;
  if (pcl::PCDReader().readHeader(argv[1], fields) != 0)
  {
    return 1;
  }
  const bool isColoured = pcl::getFieldIndex(fields, "rgb") >= 0;
  if (isColoured && pcl::io::loadPCDFile(argv[1], colours) != 0)
  {
    return 1;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    std::printf("%.9g %.9g %.9g %.9g", static_cast<double>(places[i].x),
      static_cast<double>(places[i].y), static_cast<double>(places[i].z),
      static_cast<double>(points[i].intensity));
    if (isColoured)
    {
      std::printf(" %d %d %d", colours[i].r, colours[i].g, colours[i].b);
    }
    std::printf("\n");
  }
  return 0;
}
