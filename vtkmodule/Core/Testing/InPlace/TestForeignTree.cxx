#include "pointfront/InPlace/ForeignTree.h"

#include "pointfront/Style/ColourSource.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint32_t pointsOfRoot = 5000;

/// A tree of one node on a diagonal. From point `border` on it has another class; values of the
/// column `broken` cannot be read.
class DiagonalInMemory final : public ForeignNodes
{
public:
  DiagonalInMemory(std::uint32_t border, std::optional<std::uint32_t> broken)
    : border_(border)
    , broken_(broken)
  {
  }
  Result<RawBytes> fetch(const ForeignNode&) const override { return RawBytes(1); }
  std::size_t storedBytes(const ForeignNode&) const override { return 1; }
  std::vector<std::string> files() const override { return { "diagonal" }; }
  Result<void> decode(const Part& part, const RawBytes&, PointBatch& batch) const override
  {
    batch.steps.clear();
    batch.columns.assign(2, {});
    for (std::uint32_t i = 0; i < part.first; ++i)
    {
      batch.steps.emplace_back(static_cast<int>(i));
    }
    for (const std::uint32_t column : part.columns)
    {
      // Its beginning, which is looked at when the tree is opened, is sound.
      if (column == broken_ && part.first == pointsOfRoot)
      {
        return makeError(Error::Kind::Corrupt, "the values end");
      }
      for (std::uint32_t i = 0; i < part.first; ++i)
      {
        const int value = column == 0 ? static_cast<int>(i % 100) : i < border_ ? 2 : 6;
        batch.columns[column].push_back(std::byte(value));
      }
    }
    return {};
  }

private:
  std::uint32_t border_;
  std::optional<std::uint32_t> broken_;
};

std::shared_ptr<const StoredCloud> openDiagonal(
  std::uint32_t border, std::optional<std::uint32_t> broken = std::nullopt)
{
  ForeignTreeContent content;
  content.source.path = "diagonal";
  content.source.schema.add({ "intensity", ScalarType::UInt8, 1 });
  content.source.schema.add({ "classification", ScalarType::UInt8, 1 });
  content.source.grid = QuantisationGrid{ glm::dvec3(1.0), glm::dvec3(0.0) };
  content.source.headerPointCount = pointsOfRoot;
  content.side = pointsOfRoot;
  ForeignNode root;
  root.points = pointsOfRoot;
  content.first.nodes.push_back(root);
  content.reader = std::make_shared<DiagonalInMemory>(border, broken);
  const auto tree = ForeignTree::make(std::move(content));
  EXPECT_TRUE(tree) << tree.error().what;
  return tree ? *tree : nullptr;
}

TEST(ForeignTree, ClassesThatComeLateInTheFirstNodeAreSeenWhenItIsOpened)
{
  for (const std::uint32_t border : { 500u, 1000u, 4999u })
  {
    const auto tree = openDiagonal(border);
    ASSERT_TRUE(tree);
    const StoreDescription& description = tree->description();
    EXPECT_EQ(description.ranges[1].components[0], (std::array<double, 2>{ 2.0, 6.0 })) << border;
    EXPECT_EQ(defaultColourAttribute(description), "classification") << border;
  }
  EXPECT_EQ(defaultColourAttribute(openDiagonal(pointsOfRoot)->description()), "intensity");
}

TEST(ForeignTree, OpensThoughAColumnIsDamagedThatOthersDoNotNeed)
{
  const auto tree = openDiagonal(2000, 1);
  ASSERT_TRUE(tree);
  EXPECT_TRUE(tree->read(0, { 0 }));
  EXPECT_FALSE(tree->read(0, { 1 }));
}

TEST(ForeignTree, IsSoundIfTheValuesOfAllColumnsCanBeRead)
{
  const auto sound = openDiagonal(10)->verify();
  ASSERT_TRUE(sound);
  EXPECT_TRUE(sound->ok) << sound->firstError;
  EXPECT_EQ(sound->pointsChecked, pointsOfRoot);
  const auto damaged = openDiagonal(10, 0)->verify();
  ASSERT_TRUE(damaged);
  EXPECT_FALSE(damaged->ok);
  EXPECT_EQ(damaged->firstError, "the values end");
}
} // namespace
} // namespace pointfront
