#include "PLYFormat.h"
#include "PLYWriter.h"
#include "WriterCases.h"

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

TEST_F(PLYWriterTest, SaysWhyItCannotWrite)
{
  expectReasonWhenItCannotWrite(case_);
}
} // namespace
} // namespace pointfront::test
