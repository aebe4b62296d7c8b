#include "pointfront/Statistics/StoreSample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace pointfront
{

namespace
{
/// Three levels, one node each: 100, 20,000 and 5 points. Point i of a level has z = i steps of
/// 0.5 above 1000, intensity i and, in column 1, weight i (NaN and infinities for i < 3).
class Chain final : public NodeReader
{
public:
  Chain()
  {
    schema.add(attribute("intensity", ScalarType::UInt16));
    schema.add(attribute("weight", ScalarType::Float32));
    grid.scale = glm::dvec3(0.5);
    grid.offset = glm::dvec3(0.0, 0.0, 1000.0);
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    const NodeIndex index = fetched.node;
    const ColumnSelection& selection = fetched.columns;
    reads = std::max(reads, static_cast<int>(index) + 1);
    NodeColumns node;
    node.selection = selection;
    for (std::uint32_t i = 0; i < points[index]; ++i)
    {
      node.positions.emplace_back(0u, 0u, i);
    }
    for (const std::uint32_t column : selection)
    {
      std::vector<std::byte> bytes(points[index] * schema[column].bytes());
      for (std::uint32_t i = 0; i < points[index]; ++i)
      {
        const auto integer = static_cast<std::uint16_t>(i);
        const float none[] = { std::nanf(""), HUGE_VALF, -HUGE_VALF };
        const float real = i < 3 ? none[i] : static_cast<float>(i);
        std::memcpy(bytes.data() + i * schema[column].bytes(),
          column == 0 ? static_cast<const void*>(&integer) : &real, schema[column].bytes());
      }
      node.columns.push_back(std::move(bytes));
    }
    return node;
  }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection&) const override
  {
    return 0;
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 0; }

  static HierarchyTable hierarchy()
  {
    std::vector<Node> nodes(3);
    for (NodeIndex i = 0; i < 2; ++i)
    {
      nodes[i].firstChild = i + 1;
      nodes[i].childCount = 1;
      nodes[i + 1].parent = i;
    }
    return HierarchyTable(std::move(nodes), { 0 }, Refinement::Add);
  }

  AttributeSchema schema;
  QuantisationGrid grid;
  mutable int reads = 0;
  const std::uint32_t points[3] = { 100, 20000, 5 };

private:
  static Attribute attribute(const char* name, ScalarType type)
  {
    Attribute a;
    a.name = name;
    a.type = type;
    return a;
  }
};
} // namespace

TEST(StoreSample, StopsWhenThereIsEnough)
{
  const Chain store;
  const auto sample = StoreSample::read(store.hierarchy(), store, store.grid, store.schema, {});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample.value().size(), 20100u);
  EXPECT_EQ(store.reads, 2); // the third level was not needed
}

TEST(StoreSample, QuantilesAreOfWorldZAndOfStoredValues)
{
  const Chain store;
  const auto read = StoreSample::read(store.hierarchy(), store, store.grid, store.schema, { 0, 1 });
  ASSERT_TRUE(read);
  const StoreSample& sample = read.value();
  EXPECT_EQ(sample.elevationQuantile(0.0), 1000.0);
  EXPECT_EQ(sample.elevationQuantile(1.0), 1000.0 + 0.5 * 19999);
  EXPECT_EQ(sample.columnQuantile(0, 0, 1.0), 19999.0);
  EXPECT_NEAR(sample.columnQuantile(0, 0, 0.5), 9950.0, 1.0);
  EXPECT_EQ(sample.columnQuantile(1, 0, 0.0), 3.0); // neither NaN nor infinities
  EXPECT_EQ(sample.columnQuantile(1, 0, 1.0), 19999.0);
}

TEST(StoreSample, NothingFromNothing)
{
  const Chain store;
  const HierarchyTable empty({}, {}, Refinement::Add);
  const auto sample = StoreSample::read(empty, store, store.grid, store.schema, { 0 });
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample.value().size(), 0u);
  EXPECT_EQ(sample.value().columnQuantile(0, 0, 0.5), 0.0);
}

} // namespace pointfront
