#include "TestBuildClouds.h"

#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

AttributeSchema schemaOf()
{
  AttributeSchema schema;
  schema.add({ "intensity", ScalarType::UInt16, 1 });
  schema.add({ "user_data", ScalarType::UInt8, 1 });
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  return schema;
}

/// Constant user_data 9 and colours below 256, but for the point `odd`.
std::unique_ptr<test::CloudSource> cloud(std::size_t count, std::size_t odd)
{
  auto source = std::make_unique<test::CloudSource>("cloud", schemaOf(), test::millimetres(), 100);
  for (std::size_t i = 0; i < count; ++i)
  {
    source->addPosition({ 0.01 * double(i % 97), 0.01 * double(i / 97), 0.0 });
    source->addValue(0, static_cast<std::uint16_t>(i));
    source->addValue(1, static_cast<std::uint8_t>(i == odd ? 10 : 9));
    for (int k = 0; k < 3; ++k)
    {
      source->addValue(2, static_cast<std::uint16_t>(i == odd ? 300 : i % 200));
    }
  }
  return source;
}

ColumnGuess anything()
{
  return { { true, true, false }, true };
}

class RecordColumnsOf : public testing::Test
{
protected:
  void SetUp() override { folder_ = test::freshFolder("columns"); }
  void TearDown() override { fs::remove_all(folder_); }

  /// The bytes of a store; with its values of user_data, point by point, added up.
  std::string built(std::size_t odd, unsigned threads, std::uint64_t& sum)
  {
    BuildOptions options;
    options.outputPath = (folder_ / "c.pfront").string();
    options.overwrite = true;
    options.threads = threads;
    options.nodePoints = 256;
    const auto report = buildStore(test::one(cloud(5000, odd)), options);
    EXPECT_TRUE(report) << report.error().what;
    const auto store = PointStore::open(options.outputPath);
    EXPECT_TRUE(store) << store.error().what;
    EXPECT_EQ(
      (*store)->description().schema[2].type, odd < 5000 ? ScalarType::UInt16 : ScalarType::UInt8);
    sum = 0;
    for (NodeIndex node = 0; node < (*store)->hierarchy()->nodeCount(); ++node)
    {
      const auto columns = (*store)->read(node, { 1 });
      EXPECT_TRUE(columns);
      for (const std::byte value : columns->columns[0])
      {
        sum += std::to_integer<unsigned>(value);
      }
    }
    std::ifstream file(options.outputPath, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  fs::path folder_;
};

TEST(RecordColumns, LeaveOutConstantsAndTheUpperBytesOfColours)
{
  const auto sources = test::one(cloud(2000, SIZE_MAX));
  const auto common = commonSchema(sources, {});
  ASSERT_TRUE(common);
  const RecordColumns columns = guessColumns(sources, *common, anything());
  ASSERT_EQ(columns.schema().size(), 2u);
  EXPECT_EQ(columns.schema()[0].name, "intensity");
  EXPECT_EQ(columns.schema()[1].type, ScalarType::UInt8);
  EXPECT_EQ(columns.constant(1), ConstantValue{ std::byte(9) });
  EXPECT_FALSE(columns.place(1).has_value());
  EXPECT_EQ(columns.place(2), 1u);
  EXPECT_EQ(columns.narrowed(), 2u);
  const RecordColumns all = columns.carrying(common->schema, { false, true, true });
  EXPECT_EQ(all.schema(), common->schema);
  EXPECT_FALSE(all.narrowed().has_value());
}

TEST(RecordColumns, GuessOnlyWhatTheyMayAndFromPointsOnly)
{
  const auto sources = test::one(cloud(2000, SIZE_MAX));
  const auto common = commonSchema(sources, {});
  ASSERT_TRUE(common);
  EXPECT_EQ(
    guessColumns(sources, *common, { { false, false, false }, false }).schema(), common->schema);
  const auto empty = test::one(cloud(0, SIZE_MAX));
  EXPECT_EQ(guessColumns(empty, *common, anything()).schema(), common->schema);
}

TEST_F(RecordColumnsOf, OnePointThatDiffersWhereNobodyLooked)
{
  std::uint64_t sum = 0;
  built(SIZE_MAX, 1, sum);
  EXPECT_EQ(sum, 9u * 5000u);
  constexpr std::size_t odd = 1234; // not in one of the chunks that are guessed from
  const auto sources = test::one(cloud(5000, odd));
  const auto common = commonSchema(sources, {});
  ASSERT_TRUE(common);
  ASSERT_EQ(guessColumns(sources, *common, anything()).schema().size(), 2u);
  const std::string alone = built(odd, 1, sum);
  EXPECT_EQ(sum, 9u * 5000u + 1u);
  EXPECT_EQ(alone, built(odd, 4, sum));
}

} // namespace
} // namespace pointfront
