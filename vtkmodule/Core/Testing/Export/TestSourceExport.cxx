#include "pointfront/Export/SourceExport.h"

#include "pointfront/Generate/TerrainSource.h"

#include <gtest/gtest.h>

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

} // namespace pointfront
