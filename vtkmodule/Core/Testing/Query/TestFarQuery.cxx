#include "AllocationCount.h"
#include "CountedBytes.h"
#include "SampleStore.h"
#include "StoreBuildTest.h"

#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <chrono>
#include <memory>
#include <vector>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
using Clock = std::chrono::steady_clock;

/// All batches of a query, as bytes that can be compared.
struct Answer
{
  std::vector<NodeIndex> nodes;
  std::vector<std::uint64_t> ids;
  std::vector<glm::dvec3> positions;
  std::vector<std::byte> values;

  QueryConsumer consumer()
  {
    return [this](QueryBatch& batch) -> Result<void>
    {
      nodes.push_back(batch.node);
      ids.insert(ids.end(), batch.ids.begin(), batch.ids.end());
      positions.insert(
        positions.end(), batch.points.positions.begin(), batch.points.positions.end());
      for (const auto& column : batch.points.columns)
      {
        values.insert(values.end(), column.begin(), column.end());
      }
      return {};
    };
  }
  bool operator==(const Answer& other) const
  {
    return nodes == other.nodes && ids == other.ids && positions == other.positions &&
      values == other.values;
  }
};

constexpr std::size_t pointCount = 200000;

/// A store of some 1,000 nodes behind a line of 20 ms, larger than what comes when it is opened.
class FarQueries : public StoreBuildTest
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.nodePoints = 300;
    near_ = build(hills(pointCount, 1e6));
    line_ = CountedBytes::add();
    line_->roundTrip = std::chrono::milliseconds(20);
    line_->bytesPerSecond = 50e6;
    line_->cost = { 0.02, 50e6, 8, std::size_t(128) << 10 };
    const auto far = PointStore::open(CountedBytes::addressOf(options_.outputPath));
    ASSERT_TRUE(far) << far.error().what;
    far_ = *far;
    line_->reset();
  }

  std::shared_ptr<const PointStore> near_, far_;
  std::shared_ptr<CountedBytes> line_;
};

TEST_F(FarQueries, ReadGroupsBesideEachOtherAndGiveTheSameAnswer)
{
  const QueryPlan plan = QueryPlan::make(*far_, {}).value();
  Answer expected, found;
  ASSERT_TRUE(QueryPlan::make(*near_, {}).value().run(*near_, {}, expected.consumer()));
  const auto report = plan.run(*far_, {}, found.consumer());
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_TRUE(found == expected);
  EXPECT_GT(report->nodesRead, 200u);
  const std::size_t groups = line_->bytes / line_->cost.bytesAtOnce + 1;
  EXPECT_LE(line_->rounds(), 2 * groups + 2) << report->nodesRead << " nodes";
  EXPECT_GT(line_->readsAtOnceMost, 1u);
}

/// The nodes around which there are a 128th of all points lie side by side at the end of the file.
/// In the order in which a builder finishes them they would be some sixty requests.
TEST_F(FarQueries, TheUpperLevelsOfAStoreAreOneRequest)
{
  const Hierarchy& table = *far_->hierarchy();
  std::vector<WantedNode> wanted;
  for (NodeIndex n = 0; n < table.nodeCount(); ++n)
  {
    const Node row = table.node(n);
    if (row.parent == noNode ||
      table.node(row.parent).pointsBelow - table.node(row.parent).pointCount >=
        std::max<std::uint64_t>(pointCount / 128, 4 * options_.nodePoints))
    {
      wanted.push_back({ n, everyColumn(far_->description().schema) });
    }
  }
  ASSERT_GT(wanted.size(), 100u);
  line_->reset();
  for (const auto& fetched : far_->fetchAll(wanted, ReadStop{ false }))
  {
    ASSERT_TRUE(fetched) << fetched.error().what;
  }
  EXPECT_EQ(line_->requests, 1u);
}

TEST_F(FarQueries, KeepToTheirMemory)
{
  const QueryPlan plan = QueryPlan::make(*far_, {}).value();
  for (const std::size_t memory : { 200000u, 1u << 20, 4u << 20 })
  {
    ThreadCrew crew(3);
    QueryOptions options;
    options.crew = &crew;
    options.memoryBytes = memory;
    resetPeakBytes();
    const std::size_t before = allocatedBytes();
    std::uint64_t points = 0;
    const auto report = plan.run(*far_, options,
      [&points](QueryBatch& batch) -> Result<void>
      {
        points += batch.size();
        return {};
      });
    ASSERT_TRUE(report) << report.error().what;
    EXPECT_EQ(points, pointCount);
    EXPECT_LE(peakAllocatedBytes() - before, memory);
    EXPECT_LE(report->peakBytes, memory);
    EXPECT_LT(line_->rounds(), report->nodesRead / (memory < 4u << 20 ? 1 : 4)) << memory;
    line_->reset();
  }
}

TEST_F(FarQueries, EndAtOnceWhenTheyAreStoppedWhileTheLineHangs)
{
  line_->hangAt = bytes().size() / 8;
  const QueryPlan plan = QueryPlan::make(*far_, {}).value();
  const Clock::time_point begin = Clock::now();
  QueryOptions options;
  options.progress = [&](const Progress&)
  { return Clock::now() - begin < std::chrono::milliseconds(300); };
  const auto report = plan.run(*far_, options, [](QueryBatch&) -> Result<void> { return {}; });
  line_->hangAt = UINT64_MAX;
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, Error::Kind::Cancelled);
  EXPECT_EQ(report.error().what, "reading of points was cancelled");
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(3));
}

TEST_F(FarQueries, WhatTheConsumerRefusesEndsTheReadsUnderWay)
{
  const QueryPlan plan = QueryPlan::make(*far_, {}).value();
  const std::size_t middle = bytes().size() / 4;
  std::size_t batches = 0;
  const auto report = plan.run(*far_, {},
    [&](QueryBatch&) -> Result<void>
    {
      line_->hangAt = middle;
      return ++batches < 3 ? Result<void>() : makeError(Error::Kind::Unreadable, "disk is full");
    });
  line_->hangAt = UINT64_MAX;
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().what, "disk is full");
  EXPECT_EQ(batches, 3u);
}

TEST_F(FarQueries, SayTheSameOfADamagedNode)
{
  std::vector<std::byte> bytes = fileBytes(options_.outputPath);
  bytes[bytes.size() / 8] ^= std::byte(1);
  writeFile(options_.outputPath, bytes);
  const auto near = PointStore::open(options_.outputPath);
  ASSERT_TRUE(near);
  Answer before, same;
  const auto expected = QueryPlan::make(**near, {}).value().run(**near, {}, before.consumer());
  const auto found = QueryPlan::make(*far_, {}).value().run(*far_, {}, same.consumer());
  ASSERT_FALSE(expected);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().kind, expected.error().kind);
  EXPECT_TRUE(same == before);
  const std::string node = expected.error().what.substr(expected.error().what.find("' is") + 1);
  EXPECT_NE(found.error().what.find(node), std::string::npos) << found.error().what << "\n"
                                                              << expected.error().what;
}

} // namespace
} // namespace pointfront
