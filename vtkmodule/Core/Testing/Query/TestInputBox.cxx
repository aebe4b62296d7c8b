#include "CloudInMemory.h"
#include "pointfront/Query/InputBox.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace pointfront
{
namespace
{
constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
const Bounds boxOfInputs{ { 0, 0, 0 }, { 1, 1, 1 } };

/// A source on a grid of hundredths, with its index as an attribute.
class SteppedCloud final : public PointSource
{
public:
  explicit SteppedCloud(std::vector<glm::ivec3> steps)
    : steps_(std::move(steps))
  {
    description_.grid = QuantisationGrid{ { 0.01, 0.01, 0.01 }, { 0, 0, 0 } };
    description_.schema.add({ "number", ScalarType::UInt16 });
    description_.pointCount = steps_.size();
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return 1; }
  std::uint64_t chunkPoints(std::uint64_t) const override { return steps_.size(); }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    Result<void> done = readSteps(chunk, batch);
    for (const glm::ivec3& step : batch.steps)
    {
      batch.positions.push_back(description_.grid->toWorld(GridPosition(step)));
    }
    batch.steps.clear();
    return done;
  }
  Result<void> readSteps(std::uint64_t, PointBatch& batch) const override
  {
    batch.resizeSteps(steps_.size(), description_.schema);
    for (std::size_t i = 0; i < steps_.size(); ++i)
    {
      const auto number = static_cast<std::uint16_t>(i);
      batch.steps[i] = steps_[i];
      std::memcpy(batch.columns[0].data() + i * sizeof number, &number, sizeof number);
    }
    return {};
  }

private:
  SourceDescription description_;
  std::vector<glm::ivec3> steps_;
};

std::uint16_t numberInBatch(const PointBatch& batch, std::size_t point)
{
  std::uint16_t number = 0;
  std::memcpy(&number, batch.columns[0].data() + point * sizeof number, sizeof number);
  return number;
}

TEST(InputBox, KeepsWhatIsInsideAndOnItAndCountsTheRestOnce)
{
  const auto box = InputBox::make(boxOfInputs).value();
  const auto source = box->cut(std::make_unique<test::CloudInMemory>("cloud",
    std::vector<glm::dvec3>{ { 0.5, 0.5, 0.5 }, { 1.5, 0, 0 }, { 1, 1, 1 }, { 0, 0, -0.1 },
      { noNumber, 0, 0 }, { 0, 0, 0 }, { 2, 2, 2 } },
    "", 3));
  EXPECT_EQ(box->pointsOutside(), 0u);
  std::vector<glm::dvec3> points;
  for (int round = 0; round < 2; ++round) // passes read a source again
  {
    points.clear();
    PointBatch batch;
    for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
    {
      ASSERT_TRUE(source->read(chunk, batch));
      points.insert(points.end(), batch.positions.begin(), batch.positions.end());
    }
    EXPECT_EQ(box->pointsOutside(), 4u);
  }
  EXPECT_EQ(points, (std::vector<glm::dvec3>{ { 0.5, 0.5, 0.5 }, { 1, 1, 1 }, { 0, 0, 0 } }));
}

TEST(InputBox, ColumnsStayWithTheirPointsHoweverTheyAreRead)
{
  // The end lies where the grid has a point: 0.07 is not 7 * 0.01 in floating point.
  const auto box = InputBox::make({ { 0, 0, 0 }, { 7 * 0.01, 1, 1 } }).value();
  const std::vector<glm::ivec3> steps{ { 8, 0, 0 }, { 7, 0, 0 }, { -1, 0, 0 }, { 0, 100, 100 } };
  const auto source = box->cut(std::make_unique<SteppedCloud>(steps));
  PointBatch batch;
  ASSERT_TRUE(source->readSteps(0, batch));
  ASSERT_EQ(batch.steps, (std::vector<glm::ivec3>{ { 7, 0, 0 }, { 0, 100, 100 } }));
  EXPECT_EQ(numberInBatch(batch, 0), 1u);
  EXPECT_EQ(numberInBatch(batch, 1), 3u);
  ASSERT_TRUE(source->read(0, batch));
  ASSERT_EQ(batch.positions.size(), 2u);
  EXPECT_EQ(numberInBatch(batch, 0), 1u);
  EXPECT_EQ(numberInBatch(batch, 1), 3u);
  EXPECT_EQ(box->pointsOutside(), 2u);
}

TEST(InputBox, RefusesWhatIsNoBox)
{
  for (const Bounds& box :
    { Bounds(), Bounds{ { 0, 0, 2 }, { 1, 1, 1 } }, Bounds{ { noNumber, 0, 0 }, { 1, 1, 1 } } })
  {
    const auto made = InputBox::make(box);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, Error::Kind::BadArgument);
  }
}

TEST(InputBox, LeavesOutInputsWithoutAPointAndSaysWhereTheyLie)
{
  const auto box = InputBox::make(boxOfInputs).value();
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(
    box->cut(std::make_unique<test::CloudInMemory>("one", std::vector<glm::dvec3>{ { 5, 5, 5 } })));
  sources.push_back(
    box->cut(std::make_unique<test::CloudInMemory>("none", std::vector<glm::dvec3>())));
  ASSERT_TRUE(box->keepInside(sources));
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_EQ(sources[0]->description().path, "one");
  box->leaveOut({ { 5, 5, 5 }, { 7, 8, 9 } });
  sources.clear();
  const Result<void> none = box->keepInside(sources);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().what,
    "no point of the inputs lies in the box 0,0,0,1,1,1; the inputs lie in 5,5,5,7,8,9, in their "
    "own coordinates");
}

} // namespace
} // namespace pointfront
