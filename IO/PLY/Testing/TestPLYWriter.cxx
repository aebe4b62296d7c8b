#include "PLYFormat.h"
#include "PLYWriter.h"
#include "WriterCases.h"

#include <cstring>
#include <limits>

namespace pointfront::test
{
namespace
{
class PLYWriterTest : public testing::Test
{
protected:
  PLYFormat format_;
  const WriterCase case_{ format_, "ply",
    [](const std::string& path) { return std::make_unique<PLYWriter>(path); } };
};

TEST_F(PLYWriterTest, WritesWhatTheReaderReads)
{
  expectReadAsWritten<double>(case_,
    "intensity uint16, rgb uint8x3, normal float32x3, gps_time float64, wave_offset float64, "
    "pair int16x2, width float64");
}

TEST_F(PLYWriterTest, LeavesNothingWhenItIsNotFinished)
{
  expectNothingLeftUnfinished(case_);
}

TEST_F(PLYWriterTest, WritesNoPointsAndColourOf16Bits)
{
  expectNoneAndWideColour(case_);
}

TEST_F(PLYWriterTest, GivesFieldsNamesThatItsReaderTellsApart)
{
  expectNamesToldApart(case_);
}

TEST_F(PLYWriterTest, CountsTheIntegersThatDoublesDoNotHold)
{
  SinkDescription description;
  description.schema.add({ "id", ScalarType::UInt64 });
  description.schema.add({ "pair", ScalarType::Int64, 2 });
  description.schema.add({ "small", ScalarType::Int64 });
  PointBatch batch;
  batch.resize(2, description.schema);
  const std::uint64_t ids[] = { (1ull << 53) + 1, ~0ull };
  const std::int64_t pairs[] = { -(1ll << 53) - 1, 1ll << 53,
    std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max() };
  std::memcpy(batch.columns[0].data(), ids, sizeof ids);
  std::memcpy(batch.columns[1].data(), pairs, sizeof pairs);
  PLYWriter writer(writeFile("wide.ply", ""));
  ASSERT_TRUE(writer.begin(description));
  ASSERT_TRUE(writer.append(batch));
  ASSERT_TRUE(writer.append(batch));
  ASSERT_TRUE(writer.finish());
  const std::vector<std::string> found = writer.findings();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].find("4 values of 'id' are rounded"), 0u) << found[0];
  EXPECT_EQ(found[1].find("4 values of 'pair' are rounded"), 0u) << found[1];
}

TEST_F(PLYWriterTest, SaysWhyItCannotWrite)
{
  expectReasonWhenItCannotWrite(case_);
}
} // namespace
} // namespace pointfront::test
