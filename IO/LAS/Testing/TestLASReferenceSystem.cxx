#include "FileBytes.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront::test
{
namespace
{
/// The WKT that is read from a real file after its first record of the standard's owner was given
/// to somebody else, `times` times.
std::string wktWithout(const std::string& path, int times)
{
  FileBytes bytes(sharedData(path));
  for (int i = 0; i < times; ++i)
  {
    bytes[bytes.find("LASF_Projection")] = 'x';
  }
  const auto source = openOrFail(bytes.write("owner.las"));
  return source ? source->description().crsWkt : "no source";
}

TEST(LASReferenceSystem, OfLibLASIsReadWhereTheStandardsIsMissing)
{
  const std::string path = "las/version_x_format/las1.4_pf0_10pts.las"; // both records
  const std::string wkt = wktWithout(path, 0);
  EXPECT_EQ(wkt.rfind("PROJCS[", 0), 0u) << wkt;
  EXPECT_EQ(wktWithout(path, 1), wkt);
}

TEST(LASReferenceSystem, OfLibLASGivesWayToGeoKeys)
{
  const std::string path = "las/real/autzen-utm.las"; // three records of keys, then libLAS's
  EXPECT_EQ(wktWithout(path, 0), "");
  EXPECT_EQ(wktWithout(path, 3).rfind("PROJCS[", 0), 0u) << wktWithout(path, 3);
}
} // namespace
} // namespace pointfront::test
