#include "PCDFormat.h"
#include "PCDWriter.h"
#include "WriterCases.h"

namespace pointfront::test
{
namespace
{
class PCDWriterTest : public testing::Test
{
protected:
  PCDFormat format_;
  const WriterCase case_{ format_, "pcd",
    [](const std::string& path) { return std::make_unique<PCDWriter>(path); } };
};

TEST_F(PCDWriterTest, WritesWhatTheReaderReads)
{
  expectReadAsWritten<std::uint64_t>(case_,
    "intensity uint16, rgb uint8x3, normal float32x3, gps_time float64, wave_offset uint64, "
    "pair int16x2, width float64");
}

TEST_F(PCDWriterTest, LeavesNothingWhenItIsNotFinished)
{
  expectNothingLeftUnfinished(case_);
}

TEST_F(PCDWriterTest, WritesNoPointsAndColourOf16Bits)
{
  expectNoneAndWideColour(case_);
}

TEST_F(PCDWriterTest, SaysWhyItCannotWrite)
{
  expectReasonWhenItCannotWrite(case_);
}
} // namespace
} // namespace pointfront::test
