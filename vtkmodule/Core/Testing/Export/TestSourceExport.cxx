#include "pointfront/Export/SourceExport.h"

#include "pointfront/Export/SourceSurvey.h"
#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/Points/DescribedSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace pointfront
{

namespace
{
class CountingSink final : public PointSink
{
public:
  Result<void> begin(const SinkDescription& description) override
  {
    expected = description.pointCount;
    return {};
  }
  Result<void> append(const PointBatch& batch) override
  {
    for (const glm::dvec3& p : batch.positions)
    {
      sumX += p.x;
    }
    points += batch.size();
    return {};
  }
  Result<void> finish() override
  {
    finished = true;
    return {};
  }

  std::uint64_t expected = 0;
  std::uint64_t points = 0;
  double sumX = 0.0;
  bool finished = false;
};

/// A source whose second chunk cannot be read.
class Broken final : public PointSource
{
public:
  Broken()
  {
    description_.grid = QuantisationGrid();
    description_.pointCount = 2;
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return 2; }
  std::uint64_t chunkPoints(std::uint64_t) const override { return 1; }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    batch.resize(1, description_.schema);
    return chunk == 0 ? Result<void>()
                      : Result<void>(makeError(Error::Kind::Truncated, "cut at byte 7"));
  }

private:
  SourceDescription description_;
};
} // namespace

TEST(SourceExport, BringsEveryPointOver)
{
  const TerrainSource source(200000, 3);
  ASSERT_GT(source.chunkCount(), 1u);
  double sumX = 0.0;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    ASSERT_TRUE(source.read(chunk, batch));
    for (const glm::dvec3& p : batch.positions)
    {
      sumX += p.x;
    }
  }
  CountingSink sink;
  const auto written = exportSource(source, sink);
  ASSERT_TRUE(written);
  EXPECT_EQ(written.value(), 200000u);
  EXPECT_EQ(sink.points, 200000u);
  EXPECT_EQ(sink.expected, 200000u);
  EXPECT_EQ(sink.sumX, sumX); // the same points in the same order
  EXPECT_TRUE(sink.finished);
}

TEST(SourceExport, ErrorOfTheSourceComesThrough)
{
  CountingSink sink;
  const auto written = exportSource(Broken(), sink);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, Error::Kind::Truncated);
  EXPECT_FALSE(sink.finished);
}

/// A source that says neither a box nor a grid is told of as it is, and written as it was.
TEST(SourceExport, SurveyTellsWhatTheSourceDoesNot)
{
  const auto source = std::make_shared<const TerrainSource>(20000, 3);
  SourceDescription silent = source->description();
  silent.grid.reset();
  silent.declaredBounds = Bounds();
  const auto quiet = std::make_shared<const DescribedSource>(source, silent);
  const auto told = surveyed(quiet);
  ASSERT_TRUE(told);
  Bounds box;
  double highestClass = 0.0;
  const auto classes = silent.schema.find("classification");
  ASSERT_TRUE(classes);
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(source->read(chunk, batch));
    for (const glm::dvec3& p : batch.positions)
    {
      box.add(p);
    }
    for (const std::byte code : batch.columns[*classes])
    {
      highestClass = std::max(highestClass, static_cast<double>(code));
    }
  }
  EXPECT_EQ(told->bounds.low, box.low);
  EXPECT_EQ(told->bounds.high, box.high);
  EXPECT_EQ(told->pointCount, 20000u);
  EXPECT_EQ(told->largest[*classes], highestClass);
  EXPECT_LE(told->grid.scale.x, 0.001); // a millionth of 1 km at most
  CountingSink sink;
  ASSERT_TRUE(exportSource(*quiet, *told, sink));
  EXPECT_EQ(sink.points, 20000u);
  // Where there is a grid, it stays.
  EXPECT_EQ(surveyed(source)->grid, *source->description().grid);
}

TEST(SourceExport, SurveyOfABrokenSourceIsItsError)
{
  const auto told = surveyed(std::make_shared<const Broken>());
  ASSERT_FALSE(told);
  EXPECT_EQ(told.error().kind, Error::Kind::Truncated);
}

} // namespace pointfront
