#include "CollectionTest.h"

#include "pointfront/Store/NodeRanges.h"
#include "pointfront/Tiles/TiledCloud.h"

namespace pointfront
{
namespace
{
using namespace pointfront::test;

/// Tiles of one colour each, with 8 or 16 bits.
class CollectionColours : public CollectionTest
{
protected:
  TileRequest coloured(const std::string& name, ScalarType type, std::uint16_t value, double x)
  {
    AttributeSchema schema = idSchema();
    schema.add({ "rgb", type, 3 });
    const QuantisationGrid grid = millimetres();
    auto cloud = std::make_unique<CloudSource>("tile", schema, grid);
    Random random(static_cast<std::uint64_t>(x) + 1);
    for (std::uint32_t i = 0; i < 500; ++i)
    {
      cloud->addPosition(grid.toWorld(
        grid.toGrid({ x + 16.0 * random.uniform(), 16.0 * random.uniform(), random.uniform() })));
      cloud->addValue(0, static_cast<std::uint32_t>(1000.0 * x) + i);
      cloud->addValue(1, static_cast<std::uint16_t>(i));
      for (int channel = 0; channel < 3; ++channel)
      {
        type == ScalarType::UInt8 ? cloud->addValue(2, static_cast<std::uint8_t>(value))
                                  : cloud->addValue(2, value);
      }
    }
    options_.outputPath = at(name);
    options_.colourDepth = ColourDepth::Sixteen;
    const auto report = buildStore(one(std::move(cloud)), options_);
    EXPECT_TRUE(report) << report.error().what;
    return { options_.outputPath };
  }
  TileRequest eight(const std::string& name = "8.pfront", double x = 0.0)
  {
    return coloured(name, ScalarType::UInt8, 200, x);
  }
  TileRequest sixteen(const std::string& name = "16.pfront", double x = 16.0)
  {
    return coloured(name, ScalarType::UInt16, 40000, x);
  }

  /// How many points have each red, by those of all nodes; each lies in the ranges of its node.
  static std::map<unsigned, std::size_t> reds(const StoredCloud& cloud)
  {
    std::map<unsigned, std::size_t> found;
    const AttributeSchema& schema = cloud.description().schema;
    const auto column = static_cast<std::uint32_t>(*schema.find("rgb"));
    const auto ranges = cloud.nodeRanges(rangeComponent(schema, column, 0));
    EXPECT_TRUE(ranges) << ranges.error().what;
    for (NodeIndex n = 0; n < cloud.hierarchy()->nodeCount(); ++n)
    {
      const auto node = cloud.read(n, { column });
      EXPECT_TRUE(node) << node.error().what;
      for (std::size_t i = 0; node && i < node->size(); ++i)
      {
        const std::byte* const at = node->columns[0].data() + schema[column].bytes() * i;
        std::uint16_t red = 0;
        std::memcpy(&red, at, schema[column].bytes() / 3);
        ++found[red];
        if (ranges && *ranges && n < (*ranges)->nodeCount())
        {
          const ValueRange own = (*ranges)->own(n);
          EXPECT_TRUE(own.low <= red && red <= own.high) << red << " in node " << n;
        }
      }
    }
    return found;
  }
  static double largest(const StoredCloud& cloud)
  {
    const StoreDescription& whole = cloud.description();
    return whole.ranges[*whole.schema.find("rgb")].components[0][1];
  }
  static std::size_t count(const StoredCloud& cloud, const std::string& where)
  {
    PointQuery query;
    query.where = FilterExpression::parse(where).value();
    const Result<IdsAndPlaces> found = CollectionTest::query(cloud, query);
    EXPECT_TRUE(found) << found.error().what;
    return found ? found->size() : 0;
  }
  static void expectWidened(const StoredCloud& cloud)
  {
    const std::map<unsigned, std::size_t> expected{ { 40000, 500 }, { 200 * 257, 500 } };
    EXPECT_EQ(reds(cloud), expected);
    EXPECT_EQ(largest(cloud), 51400.0);
    EXPECT_EQ(count(cloud, "rgb[0] == 51400"), 500u);
    EXPECT_EQ(count(cloud, "rgb[0] < 40000"), 0u);
  }
};

TEST_F(CollectionColours, Of8BitsAreWidenedInAList)
{
  const auto cloud = TiledCloud::open(at("all.pfronts"), { eight().path, sixteen().path }, {});
  ASSERT_TRUE(cloud) << cloud.error().what;
  expectWidened(**cloud);
}

TEST_F(CollectionColours, Of8BitsAreWidenedInACollection)
{
  created({ eight(), sixteen() });
  expectWidened(*opened());
}

TEST_F(CollectionColours, OfHeadsAreWidenedWhenTilesOf16BitsCome)
{
  created({ eight() });
  EXPECT_EQ(largest(*opened()), 200.0);
  sound(addTiles(city(), { sixteen() }, {}));
  expectWidened(*opened());
  // Colours that were widened stay so until `compact`, in heads and tiles alike.
  sound(removeTiles(city(), { "16" }, {}));
  const std::map<unsigned, std::size_t> wide{ { 51400, 500 } };
  EXPECT_EQ(reds(*opened()), wide);
  EXPECT_EQ(largest(*opened()), 51400.0);
  sound(compactCollection(city(), {}));
  const std::map<unsigned, std::size_t> narrow{ { 200, 500 } };
  EXPECT_EQ(reds(*opened()), narrow);
}

TEST_F(CollectionColours, Of16BitsStayHoweverSmall)
{
  const TileRequest dark = coloured("dark.pfront", ScalarType::UInt16, 200, 0.0);
  created({ dark });
  sound(addTiles(city(), { sixteen() }, {}));
  const std::map<unsigned, std::size_t> expected{ { 200, 500 }, { 40000, 500 } };
  EXPECT_EQ(reds(*opened()), expected);
  created({ dark, eight("8.pfront", 32.0) });
  const std::map<unsigned, std::size_t> both{ { 200, 500 }, { 51400, 500 } };
  EXPECT_EQ(reds(*opened()), both);
}
} // namespace
} // namespace pointfront
