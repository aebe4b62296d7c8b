#include "pointfront/InPlace/CloudWithNormals.h"

#include "SampleStore.h"

#include "pointfront/Query/ChosenColumns.h"
#include "pointfront/Store/ColumnStatistics.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
/// Each normal tells the number of its point.
class CountedNormals final : public NodeNormals
{
public:
  std::string origin() const override { return "of the test"; }
  void compute(
    const std::vector<glm::dvec3>& positions, std::vector<PackedNormal>& normals) const override
  {
    ++computed;
    normals.clear();
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      normals.emplace_back(static_cast<std::int16_t>(i), 1, 2);
    }
  }
  mutable std::atomic<int> computed{ 0 };
};

struct Wrapped
{
  std::shared_ptr<const StoredCloud> inner;
  std::shared_ptr<const CountedNormals> numbers = std::make_shared<const CountedNormals>();
  std::shared_ptr<const StoredCloud> cloud;

  Wrapped()
  {
    const std::string path = temporaryPath("sample.pfront");
    SampleStore sample = makeSample(300);
    AttributeSchema schema; // the same without normals
    for (Attribute attribute : sample.description.schema)
    {
      attribute.name = attribute.name == "normal" ? "surface" : attribute.name;
      schema.add(std::move(attribute));
    }
    sample.description.schema = std::move(schema);
    writeSample(sample, path);
    auto store = PointStore::open(path);
    EXPECT_TRUE(store);
    inner = *store;
    cloud = CloudWithNormals::over(inner, numbers);
  }
  std::uint32_t column() const
  {
    return static_cast<std::uint32_t>(inner->description().schema.size());
  }
};

TEST(CloudWithNormals, AreComputedForThoseWhoNameThemOnly)
{
  const Wrapped wrapped;
  const StoreDescription& description = wrapped.cloud->description();
  ASSERT_EQ(*description.schema.find("normal"), wrapped.column());
  EXPECT_TRUE(description.isComputed(wrapped.column()));
  EXPECT_FALSE(description.isComputed(0));
  EXPECT_NE(
    description.schema[wrapped.column()].description.find("of the test"), std::string::npos);

  const auto all = ChosenColumns::make(description, std::nullopt);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->columns.size(), wrapped.column());
  EXPECT_EQ(ChosenColumns::ofInput(description).columns, all->columns);
  for (NodeIndex node = 0; node < wrapped.cloud->hierarchy()->nodeCount(); ++node)
  {
    const auto read = wrapped.cloud->read(node, all->columns);
    const auto inner = wrapped.inner->read(node, all->columns);
    ASSERT_TRUE(read && inner);
    EXPECT_EQ(read->columns, inner->columns);
  }
  EXPECT_TRUE(wrapped.cloud->verify()->ok);
  EXPECT_EQ(wrapped.numbers->computed, 0);

  const auto named = ChosenColumns::make(description, std::vector<std::string>{ "Normal" });
  ASSERT_TRUE(named);
  EXPECT_EQ(named->columns, ColumnSelection{ wrapped.column() });
  EXPECT_FALSE(named->description.isComputed(0)); // for who gets the points they are as others
}

TEST(CloudWithNormals, ComeBehindTheOtherColumnsAndAreCounted)
{
  const Wrapped wrapped;
  const ColumnSelection columns{ 1, 2, wrapped.column() };
  for (NodeIndex node = 0; node < wrapped.cloud->hierarchy()->nodeCount(); ++node)
  {
    const auto read = wrapped.cloud->read(node, columns);
    const auto inner = wrapped.inner->read(node, { 1, 2 });
    ASSERT_TRUE(read && inner);
    EXPECT_EQ(read->selection, columns);
    EXPECT_EQ(read->positions, inner->positions);
    ASSERT_EQ(read->columns.size(), 3u);
    EXPECT_EQ(read->columns[1], inner->columns[1]);
    const auto points = static_cast<std::uint32_t>(read->size());
    EXPECT_EQ(read->bytes(), wrapped.cloud->decodedBytes(node, points, columns));
    EXPECT_EQ(
      wrapped.cloud->storedBytes(node, columns), wrapped.inner->storedBytes(node, { 1, 2 }));
    for (std::uint32_t i = 0; i < points; ++i)
    {
      PackedNormal normal;
      std::memcpy(&normal, read->columns[2].data() + i * sizeof normal, sizeof normal);
      ASSERT_EQ(normal, PackedNormal(static_cast<std::int16_t>(i), 1, 2));
    }
  }
}

TEST(CloudWithNormals, TheirRangesAreNotKnownBeforehand)
{
  const Wrapped wrapped;
  const std::uint32_t components = rangeComponents(wrapped.inner->description().schema);
  const auto known = wrapped.cloud->nodeRanges(components - 1);
  ASSERT_TRUE(known);
  EXPECT_NE(*known, nullptr);
  for (std::uint32_t c = components; c < components + 3; ++c)
  {
    const auto unknown = wrapped.cloud->nodeRanges(c);
    ASSERT_TRUE(unknown);
    EXPECT_EQ(*unknown, nullptr);
  }
  ASSERT_EQ(wrapped.cloud->description().ranges.size(), wrapped.column() + 1u);
}

TEST(CloudWithNormals, ACloudWithNormalsStaysAsItIs)
{
  const Wrapped wrapped;
  const auto again = CloudWithNormals::over(wrapped.cloud, wrapped.numbers);
  EXPECT_EQ(again, wrapped.cloud);
}
} // namespace
} // namespace pointfront
