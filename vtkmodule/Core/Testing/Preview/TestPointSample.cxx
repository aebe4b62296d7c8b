#include "TestBuildClouds.h"

#include "pointfront/Preview/PointSample.h"

#include <gtest/gtest.h>

#include <set>

namespace pointfront
{
namespace
{
using test::one;

PointSources lineOf(std::size_t points, std::uint64_t chunk)
{
  return one(test::cloudOf(
    points, test::millimetres(),
    [](std::size_t i) -> GridPosition {
      return { static_cast<std::int64_t>(i), 0, 0 };
    },
    chunk));
}

void keepAll(PointSample& sample, const PointSources& sources, double share)
{
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < sources[0]->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(sources[0]->read(chunk, batch));
    sample.keep(0, chunk, sources[0]->description(), batch, share);
  }
}

/// The "id" column of all points, in order: input indices.
std::vector<std::uint32_t> idsOf(const PointSource& source)
{
  std::vector<std::uint32_t> ids;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    EXPECT_TRUE(source.read(chunk, batch));
    EXPECT_EQ(batch.size(), source.chunkPoints(chunk));
    const std::size_t before = ids.size();
    ids.resize(before + batch.size());
    std::memcpy(ids.data() + before, batch.columns[0].data(), batch.columns[0].size());
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      EXPECT_NEAR(batch.positions[i].x, 0.001 * ids[before + i], 1e-9);
    }
  }
  return ids;
}

TEST(PointSample, KeepsAShareInRandomSteps)
{
  const PointSources sources = lineOf(100000, 5000);
  PointSample sample;
  keepAll(sample, sources, 0.01);
  EXPECT_NEAR(static_cast<double>(sample.points()), 1000.0, 60.0);
  const PointSources kept = sample.snapshot(sources, { "owner", 7, "", {} });
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0]->description().pointCount, sample.points());
  ASSERT_FALSE(kept[0]->description().metadata.empty());
  EXPECT_EQ(kept[0]->description().metadata.back().id, 7);
  const std::vector<std::uint32_t> ids = idsOf(*kept[0]);
  std::set<std::uint32_t> steps;
  for (std::size_t i = 1; i < ids.size(); ++i)
  {
    ASSERT_GT(ids[i], ids[i - 1]);
    steps.insert(ids[i] - ids[i - 1]);
  }
  EXPECT_GT(steps.size(), 100u) << "steps of one length would show the scanner's pattern";
  EXPECT_LT(*steps.rbegin(), 450u) << "a hole";
}

TEST(PointSample, IsTheSameInAnyOrderOfReading)
{
  const PointSources sources = lineOf(20000, 1000);
  PointSample forwards;
  PointSample backwards;
  keepAll(forwards, sources, 0.1);
  PointBatch batch;
  for (std::uint64_t chunk = sources[0]->chunkCount(); chunk-- > 0;)
  {
    ASSERT_TRUE(sources[0]->read(chunk, batch));
    backwards.keep(0, chunk, sources[0]->description(), batch, 0.1);
  }
  EXPECT_EQ(idsOf(*forwards.snapshot(sources, {})[0]), idsOf(*backwards.snapshot(sources, {})[0]));
}

TEST(PointSample, AChunkThatIsReadAgainReplacesWhatItGave)
{
  const PointSources sources = lineOf(10000, 10000);
  PointSample sample;
  keepAll(sample, sources, 1.0);
  EXPECT_EQ(sample.points(), 10000u);
  const PointSources before = sample.snapshot(sources, {});
  keepAll(sample, sources, 0.01);
  EXPECT_LT(sample.points(), 200u);
  EXPECT_EQ(idsOf(*before[0]).size(), 10000u) << "a snapshot does not change any more";
  sample.clear();
  EXPECT_EQ(sample.points(), 0u);
  EXPECT_EQ(sample.snapshot(sources, {})[0]->chunkCount(), 0u);
}

} // namespace
} // namespace pointfront
