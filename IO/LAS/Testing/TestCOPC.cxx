#include "COPCFile.h"
#include "LASFormat.h"
#include "LAZGlance.h"

#include "PointValues.h"
#include "QueryOracle.h"
#include "RandomRounds.h"

#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Query/StoredPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

const std::string copcFolder = std::string(POINTFRONT_SHARED_DATA) + "/copc/";

std::shared_ptr<const StoredCloud> openCOPC(const std::string& name)
{
  auto cloud = COPCFormat().open(copcFolder + name);
  EXPECT_TRUE(cloud) << cloud.error().what;
  return cloud ? *cloud : nullptr;
}

/// Grid steps and the bytes of all columns.
using Record = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::string>;

std::multiset<Record> recordsOf(const PointSource& source)
{
  std::multiset<Record> records;
  const PointBatch all = readPoints(source);
  const SourceDescription& description = source.description();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const GridPosition g = description.grid->toGrid(all.positions[i]);
    std::string values;
    for (std::size_t c = 0; c < all.columns.size(); ++c)
    {
      const std::size_t bytes = description.schema[c].bytes();
      values.append(reinterpret_cast<const char*>(all.columns[c].data()) + i * bytes, bytes);
    }
    records.emplace(g.x, g.y, g.z, std::move(values));
  }
  return records;
}

TEST(COPC, HoldsThePointsThatTheFileHolds)
{
  for (const char* name :
    { "1.2-with-color.copc.laz", "ellipsoid_200k.copc.laz", "lone-star.copc.laz" })
  {
    SCOPED_TRACE(name);
    const auto cloud = openCOPC(name);
    ASSERT_TRUE(cloud);
    const auto inPlace = StoredPoints::open(cloud);
    ASSERT_TRUE(inPlace);
    const auto file = openPoints(LASFormat(), copcFolder + name);
    ASSERT_TRUE(file);
    EXPECT_TRUE((*inPlace)->description().schema == file->description().schema);
    EXPECT_TRUE(recordsOf(**inPlace) == recordsOf(*file));
  }
}

TEST(COPC, IsSoundAndSaysWhatItIs)
{
  const auto cloud = openCOPC("lone-star.copc.laz");
  ASSERT_TRUE(cloud);
  const StoreDescription& description = cloud->description();
  EXPECT_EQ(description.pointCount, 518862u);
  EXPECT_EQ(description.structure, "octree");
  EXPECT_EQ(cloud->hierarchy()->nodeCount(), 15u);
  EXPECT_FALSE(description.crsWkt.empty());
  EXPECT_TRUE(description.warnings.empty());
  const auto verified = cloud->verify();
  ASSERT_TRUE(verified);
  EXPECT_TRUE(verified->ok) << verified->firstError;
  const Hierarchy& table = *cloud->hierarchy();
  for (NodeIndex i = 1; i < table.nodeCount(); ++i)
  {
    const Node node = table.node(i);
    const Node parent = table.node(node.parent);
    EXPECT_EQ(node.level, parent.level + 1);
    EXPECT_FLOAT_EQ(node.spacing, 0.5f * parent.spacing);
    EXPECT_TRUE(parent.firstChild <= i && i < parent.firstChild + parent.childCount);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_LE(parent.box().low[axis], node.box().low[axis] + 1e-3);
      EXPECT_GE(parent.box().high[axis], node.box().high[axis] - 1e-3);
    }
  }
}

TEST(COPC, EveryPrefixOfANodeIsSpreadOverIt)
{
  const auto cloud = openCOPC("lone-star.copc.laz");
  ASSERT_TRUE(cloud);
  const auto node = cloud->read(0, {});
  ASSERT_TRUE(node);
  // Points of each quarter of the node's box on the map: in an eighth of it about an eighth.
  glm::u32vec3 high(0);
  for (const glm::u32vec3& p : node->positions)
  {
    high = glm::max(high, p);
  }
  const auto quarters = [&](std::size_t count)
  {
    std::array<double, 4> points{};
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::u32vec3& p = node->positions[i];
      points[(p.x > high.x / 2 ? 1 : 0) + (p.y > high.y / 2 ? 2 : 0)] += 1.0;
    }
    return points;
  };
  const auto whole = quarters(node->size());
  const auto part = quarters(node->size() / 8);
  for (std::size_t q = 0; q < 4; ++q)
  {
    EXPECT_NEAR(part[q], whole[q] / 8.0, 0.02 * static_cast<double>(node->size()) / 8.0 + 8.0);
  }
}

TEST(COPC, ReadsTheSameValuesOfOneColumnAsOfAll)
{
  const auto cloud = openCOPC("1.2-with-color.copc.laz");
  ASSERT_TRUE(cloud);
  const AttributeSchema& schema = cloud->description().schema;
  ColumnSelection all(schema.size());
  for (std::uint32_t c = 0; c < all.size(); ++c)
  {
    all[c] = c;
  }
  for (NodeIndex i = 0; i < cloud->hierarchy()->nodeCount(); ++i)
  {
    const auto whole = cloud->read(i, all);
    ASSERT_TRUE(whole) << whole.error().what;
    for (const std::uint32_t column : all)
    {
      const auto one = cloud->read(i, { column });
      ASSERT_TRUE(one);
      EXPECT_TRUE(one->positions == whole->positions);
      EXPECT_TRUE(one->columns[0] == whole->columns[column]) << schema[column].name;
    }
  }
}

/// Boxes whose sides lie between two steps of the grid, so that no rounding decides.
void expectBoxes(const StoredCloud& cloud, const PointSource& file, int count, double largest)
{
  const PointBatch all = readPoints(file);
  const QuantisationGrid& grid = *file.description().grid;
  OracleRandom random(17);
  for (int n = 0; n < count; ++n)
  {
    Bounds box;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Bounds& whole = file.description().declaredBounds;
      const double side = whole.size()[axis];
      const double at = whole.low[axis] + side * double(random.upTo(1000)) / 1000.0;
      const double half = 0.5 * largest * side * double(random.upTo(1000)) / 1000.0;
      const auto between = [&](double v)
      {
        const double step = std::floor((v - grid.offset[axis]) / grid.scale[axis]) + 0.5;
        return grid.offset[axis] + grid.scale[axis] * step;
      };
      box.low[axis] = between(at - half);
      box.high[axis] = between(at + half);
    }
    std::size_t wanted = 0;
    for (const glm::dvec3& p : all.positions)
    {
      wanted += box.contains(p) ? 1 : 0;
    }
    PointQuery query;
    query.regions = { *BoxRegion::make(box) };
    query.attributes = std::vector<std::string>();
    std::size_t found = 0;
    const auto report = queryPoints(cloud, query, {},
      [&](QueryBatch& batch) -> Result<void>
      {
        for (const glm::dvec3& p : batch.points.positions)
        {
          EXPECT_TRUE(box.contains(p));
        }
        found += batch.size();
        return {};
      });
    ASSERT_TRUE(report) << report.error().what;
    ASSERT_EQ(found, wanted) << "box " << n;
  }
}

TEST(COPC, AThousandBoxesGiveWhatAFilterOfAllPointsGives)
{
  const std::string name = "1.2-with-color.copc.laz";
  const auto cloud = openCOPC(name);
  const auto file = openPoints(LASFormat(), copcFolder + name);
  ASSERT_TRUE(cloud && file);
  expectBoxes(*cloud, *file, randomRounds(1000), 0.8);
}

TEST(COPC, SmallBoxesOfManyPoints)
{
  const std::string name = "lone-star.copc.laz";
  const auto cloud = openCOPC(name);
  const auto file = openPoints(LASFormat(), copcFolder + name);
  ASSERT_TRUE(cloud && file);
  expectBoxes(*cloud, *file, 10, 0.2);
}

ColumnSelection allColumns(const StoredCloud& cloud)
{
  ColumnSelection all(cloud.description().schema.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

TEST(COPC, AFileIsSoundIfAllItsValuesCanBeRead)
{
  const std::string sound = bytesOfFile(copcFolder + "1.2-with-color.copc.laz");
  int readable = 0;
  int broken = 0;
  // From behind the header and its records: the points and what follows them.
  for (std::size_t at = 2000; at < sound.size(); at += 487)
  {
    std::string bytes = sound;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    const auto cloud = COPCFormat().open(writeFile("flip.copc.laz", bytes));
    if (!cloud)
    {
      continue;
    }
    bool readAll = true;
    for (NodeIndex i = 0; i < (*cloud)->hierarchy()->nodeCount(); ++i)
    {
      readAll = readAll && static_cast<bool>((*cloud)->read(i, allColumns(**cloud)));
    }
    const auto verified = (*cloud)->verify();
    ASSERT_TRUE(verified) << verified.error().what;
    EXPECT_TRUE(readAll || !verified->ok) << "a bit of byte " << at;
    (readAll ? readable : broken) += 1;
  }
  EXPECT_GT(readable, 5);
  EXPECT_GT(broken, 5);
}

TEST(COPC, EveryCutAndMostFlipsAreToldFromASoundFile)
{
  const std::string sound = bytesOfFile(copcFolder + "1.2-with-color.copc.laz");
  const auto opens = [](const std::string& bytes)
  {
    const std::string path = writeFile("cut.copc.laz", bytes);
    const auto cloud = COPCFormat().open(path);
    if (!cloud)
    {
      EXPECT_FALSE(cloud.error().what.empty());
      return false;
    }
    const auto verified = (*cloud)->verify();
    return verified && verified->ok;
  };
  EXPECT_TRUE(opens(sound));
  for (std::size_t size = 0; size < sound.size(); size += 997)
  {
    EXPECT_FALSE(opens(sound.substr(0, size))) << size;
  }
  OracleRandom random(5);
  for (int flip = 0; flip < 200; ++flip) // whatever comes out: no crash, no hang
  {
    std::string bytes = sound;
    for (int n = 0; n < 4; ++n)
    {
      bytes[static_cast<std::size_t>(random.upTo(std::int64_t(bytes.size()) - 1))] =
        static_cast<char>(random.upTo(255));
    }
    opens(bytes);
  }
}

TEST(LAZGlance, ShowsTheFirstPointOfEachChunk)
{
  const std::string folder = std::string(POINTFRONT_SHARED_DATA) + "/laz";
  EXPECT_FALSE(LAZGlanceFormat().accepts(folder + "/extrabytes.laz")) << "a folder, no file";
  std::vector<std::string> files{ copcFolder + "1.2-with-color.copc.laz" };
  const auto cloud = glanceAtLAS("glance", files);
  ASSERT_TRUE(cloud) << cloud.error().what;
  EXPECT_EQ((*cloud)->hierarchy()->nodeCount(), 1u);
  EXPECT_GT((*cloud)->description().pointCount, 10u); // its chunks are the nodes with points
  EXPECT_EQ((*cloud)->description().warnings.size(), 1u);
  // Each of them is a point of the file.
  const auto glanced = StoredPoints::open(*cloud);
  ASSERT_TRUE(glanced);
  std::multiset<Record> all = recordsOf(*openPoints(LASFormat(), files[0]));
  for (const Record& record : recordsOf(**glanced))
  {
    const auto found = all.find(record);
    ASSERT_TRUE(found != all.end());
    all.erase(found);
  }
}

TEST(LAZGlance, NamesWhatCannotBeRead)
{
  const std::string broken = writeFile("broken.laz", "LASF");
  const auto cloud = glanceAtLAS("glance", { copcFolder + "1.2-with-color.copc.laz", broken });
  ASSERT_FALSE(cloud);
  EXPECT_NE(cloud.error().what.find("1 of 2 files"), std::string::npos) << cloud.error().what;
  EXPECT_FALSE(glanceAtLAS("glance", {}));
}
} // namespace
} // namespace pointfront
