#include "StoreBuildTest.h"

#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Query/StoredPoints.h"
#include "pointfront/Store/PreviewRecord.h"

#include <map>
#include <set>
#include <tuple>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
using Sources = std::vector<std::unique_ptr<PointSource>>;

/// Grid position, id and the bytes of all other columns of each point.
using Records = std::multiset<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::string>>;

Records recordsOf(const PointSource& source)
{
  Records records;
  PointBatch batch;
  const SourceDescription& description = source.description();
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    const auto read = source.read(chunk, batch);
    EXPECT_TRUE(read) << read.error().what;
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const GridPosition g = description.grid->toGrid(batch.positions[i]);
      std::string values;
      for (std::size_t c = 0; c < batch.columns.size(); ++c)
      {
        const std::size_t bytes = description.schema[c].bytes();
        values.append(reinterpret_cast<const char*>(batch.columns[c].data()) + i * bytes, bytes);
      }
      records.emplace(g.x, g.y, g.z, std::move(values));
    }
  }
  return records;
}

class BuildFromStores : public StoreBuildTest
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.nodePoints = 64;
  }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  std::string store(const std::string& name, const Sources& sources)
  {
    options_.outputPath = at(name);
    const auto report = buildStore(sources, options_);
    EXPECT_TRUE(report) << report.error().what;
    return options_.outputPath;
  }
  static std::unique_ptr<PointSource> opened(const std::string& path)
  {
    auto store = PointStore::open(path);
    EXPECT_TRUE(store) << store.error().what;
    auto points = StoredPoints::open(std::move(*store));
    EXPECT_TRUE(points) << points.error().what;
    return std::move(*points);
  }
  static Sources stores(const std::vector<std::string>& paths)
  {
    Sources sources;
    for (const std::string& path : paths)
    {
      sources.push_back(opened(path));
    }
    return sources;
  }
  static Records pointsOf(const std::string& path) { return recordsOf(*opened(path)); }
};

std::unique_ptr<CloudSource> someOf(std::size_t first, std::size_t end)
{
  // Every point of the cloud, so that both parts take the same random numbers.
  const auto all = hills(1065, 40000.0);
  auto part = std::make_unique<CloudSource>("part", idSchema(), millimetres());
  for (std::size_t i = first; i < end; ++i)
  {
    part->addPosition(all->positions()[i]);
    part->addValue(0, static_cast<std::uint32_t>(i));
    part->addValue(1, static_cast<std::uint16_t>(i * 7));
  }
  part->editDescription().crsWkt = "LOCAL_CS[\"site\"]";
  part->editDescription().metadata = { { "liblas", 2112, "CRS", { std::byte(1), std::byte(2) } } };
  return part;
}

TEST_F(BuildFromStores, PointsGoFromStoreToStoreOfEveryStructure)
{
  const Records whole = recordsOf(*someOf(0, 1065));
  ASSERT_EQ(whole.size(), 1065u);
  const std::string add = store("add.pfront", one(someOf(0, 1065)));
  EXPECT_EQ(pointsOf(add), whole);
  options_.refinement = Refinement::Replace;
  const std::string replace = store("replace.pfront", stores({ add }));
  EXPECT_EQ(pointsOf(replace), whole);
  options_.refinement = Refinement::Add;
  options_.structure = Structure::KdTree;
  const std::string tree = store("tree.pfront", stores({ replace }));
  EXPECT_EQ(pointsOf(tree), whole);
  options_.structure = Structure::Octree;
  const std::string back = store("back.pfront", stores({ tree }));
  EXPECT_EQ(pointsOf(back), whole);

  const auto first = PointStore::open(add);
  const auto last = PointStore::open(back);
  ASSERT_TRUE(first && last);
  const StoreDescription& was = (*first)->description();
  const StoreDescription& is = (*last)->description();
  EXPECT_EQ(is.grid, was.grid);
  EXPECT_EQ(is.schema, was.schema) << "no radius of representatives stays behind";
  EXPECT_EQ(is.crsWkt, was.crsWkt);
  ASSERT_EQ(is.metadata.size(), 1u);
  EXPECT_EQ(is.metadata[0].payload, was.metadata[0].payload);
  ASSERT_EQ(is.ranges.size(), was.ranges.size());
  for (std::size_t c = 0; c < is.ranges.size(); ++c)
  {
    EXPECT_EQ(is.ranges[c].components, was.ranges[c].components);
  }
  EXPECT_EQ((*last)->hierarchy()->nodeCount(), (*first)->hierarchy()->nodeCount());
}

TEST_F(BuildFromStores, TwoHalvesAreTheWhole)
{
  const std::string one = store("one.pfront", test::one(someOf(0, 500)));
  options_.structure = Structure::KdTree;
  const std::string other = store("other.pfront", test::one(someOf(500, 1065)));
  options_.structure = Structure::Octree;
  EXPECT_EQ(pointsOf(store("both.pfront", stores({ one, other }))), recordsOf(*someOf(0, 1065)));
}

TEST_F(BuildFromStores, TakesStoresAndOtherSourcesTogether)
{
  Sources mixed = stores({ store("one.pfront", one(someOf(0, 500))) });
  mixed.push_back(someOf(500, 1065));
  EXPECT_EQ(pointsOf(store("both.pfront", mixed)), recordsOf(*someOf(0, 1065)));
}

TEST_F(BuildFromStores, DoesNotWriteOverItsInput)
{
  const std::string input = store("one.pfront", one(someOf(0, 1065)));
  const std::string before = bytes();
  const Sources sources = stores({ input });
  const auto report = buildStore(sources, options_); // the same path, overwrite allowed
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().what.find("which is read"), std::string::npos) << report.error().what;
  EXPECT_EQ(bytes(), before);
}

TEST_F(BuildFromStores, RefusesAPreview)
{
  auto cloud = someOf(0, 100);
  cloud->editDescription().metadata.push_back(previewMetadata({ "whole.pfront", 1065, 100, 0 }));
  // Only previews of running builds open, so the record is all that can be tested here.
  EXPECT_TRUE(previewRecordOf(cloud->description().metadata));
  const std::string path = store("preview.pfront", one(std::move(cloud)));
  const auto opened = PointStore::open(path);
  EXPECT_FALSE(opened && StoredPoints::open(*opened));
}

TEST_F(BuildFromStores, TellsWhatOneOfThemLacks)
{
  const std::string full = store("full.pfront", one(someOf(0, 500)));
  options_.attributes = { { "id" } };
  const std::string poor = store("poor.pfront", one(someOf(500, 1065)));
  options_.attributes.reset();
  options_.outputPath = at("both.pfront");
  const auto report = buildStore(stores({ full, poor }), options_);
  ASSERT_TRUE(report) << report.error().what;
  bool told = false;
  for (const std::string& warning : report->warnings)
  {
    told = told ||
      (warning.find("poor.pfront") != std::string::npos &&
        warning.find("lacks intensity") != std::string::npos);
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(report->pointsStored, 1065u);
}

std::unique_ptr<CloudSource> radii(double base, std::uint8_t code, double x)
{
  AttributeSchema schema;
  schema.add(splatRadiusColumn());
  auto cloud = std::make_unique<CloudSource>("radii", schema, millimetres());
  for (int i = 0; i < 10; ++i)
  {
    cloud->addPosition({ x + i, 0.0, 0.0 });
    cloud->addValue(0, i == 0 ? std::uint8_t(0) : code);
  }
  cloud->editDescription().splatRadiusBase = base;
  return cloud;
}

TEST_F(BuildFromStores, RadiiOfDifferentBasesKeepTheirMeaning)
{
  const std::string near = store("near.pfront", one(radii(0.25, 140, 0.0)));
  const std::string far = store("far.pfront", one(radii(1.0, 150, 100.0)));
  const auto points = opened(store("both.pfront", stores({ near, far })));
  EXPECT_EQ(points->description().splatRadiusBase, 1.0);
  std::map<std::uint8_t, int> codes;
  for (const auto& [x, y, z, values] : recordsOf(*points))
  {
    ++codes[static_cast<std::uint8_t>(values[0])];
  }
  const std::map<std::uint8_t, int> expected{ { 0, 2 }, { 140 - 32, 9 }, { 150, 9 } };
  EXPECT_EQ(codes, expected);
}

std::unique_ptr<CloudSource> coloured(std::uint16_t most, double x)
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  auto cloud = std::make_unique<CloudSource>("coloured", schema, millimetres());
  for (std::uint16_t i = 0; i < 10; ++i)
  {
    cloud->addPosition({ x + i, 0.0, 0.0 });
    cloud->addValue(
      0, std::array<std::uint16_t, 3>{ std::uint16_t(most - i), i, std::uint16_t(0) });
  }
  return cloud;
}

TEST_F(BuildFromStores, ColoursOf16BitsStayAsTheyAreStored)
{
  // Dark, but of 16 bits: who built the store has said so.
  options_.colourDepth = ColourDepth::Sixteen;
  const std::string dark = store("dark.pfront", one(coloured(200, 0.0)));
  options_.colourDepth = ColourDepth::ByFile;
  const std::string bright = store("bright.pfront", one(coloured(60000, 100.0)));
  EXPECT_EQ(pointsOf(store("again.pfront", stores({ dark }))), pointsOf(dark));
  Records both = pointsOf(dark);
  Records more = pointsOf(bright);
  const QuantisationGrid grid = opened(dark)->description().grid.value();
  ASSERT_EQ(grid, opened(bright)->description().grid.value());
  both.merge(more);
  EXPECT_EQ(pointsOf(store("both.pfront", stores({ dark, bright }))), both);
}
} // namespace
} // namespace pointfront
