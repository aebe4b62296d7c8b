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
  const WriterCase exact_{ format_, "pcd",
    [](const std::string& path)
    { return std::make_unique<PCDWriter>(path, PCDWriter::Coordinates::Float64); } };

  /// Points of a grid of 1 mm at and beside `low`, written and read again.
  std::unique_ptr<PointSource> written(const glm::dvec3& low, const glm::dvec3& size)
  {
    SinkDescription description;
    description.grid.scale = glm::dvec3(0.001);
    description.bounds = { low, low + size };
    PointBatch batch;
    batch.resize(3, {});
    batch.positions = { low, low + 0.5 * size, low + size };
    const std::string path = writeFile("float.pcd", "");
    PCDWriter writer(path);
    EXPECT_TRUE(writer.begin(description));
    EXPECT_TRUE(writer.append(batch));
    EXPECT_TRUE(writer.finish());
    findings_ = writer.findings();
    header_ = bytesOfFile(path).substr(0, 200);
    return openPoints(format_, path);
  }
  std::vector<std::string> findings_;
  std::string header_;
};

TEST_F(PCDWriterTest, WritesFloatsAboutAnOriginThatItStates)
{
  const glm::dvec3 low(637012.241, 5849028.317, 431.663);
  const glm::dvec3 size(2000.0, 3000.0, 100.0);
  const auto source = written(low, size);
  ASSERT_TRUE(source);
  EXPECT_NE(header_.find("# ORIGIN 638012 5850528 482\n"), std::string::npos) << header_;
  EXPECT_NE(header_.find("SIZE 4 4 4\nTYPE F F F\n"), std::string::npos) << header_;
  ASSERT_EQ(findings_.size(), 1u);
  EXPECT_NE(findings_[0].find("638012 5850528 482"), std::string::npos) << findings_[0];
  ASSERT_TRUE(source->description().grid); // the same integers come back
  EXPECT_EQ(source->description().grid->scale, glm::dvec3(0.001));
  const QuantisationGrid grid{ glm::dvec3(0.001), glm::dvec3(0.0) };
  EXPECT_EQ(grid.toGrid(readPoints(*source).positions[0]), grid.toGrid(low));
  EXPECT_EQ(grid.toGrid(readPoints(*source).positions[2]), grid.toGrid(low + size));
}

TEST_F(PCDWriterTest, TellsWhatFloatsRoundAndNeedsNoOriginNearZero)
{
  ASSERT_TRUE(written(glm::dvec3(1.0, -2.0, 0.5), glm::dvec3(3.0)));
  EXPECT_EQ(header_.find("ORIGIN"), std::string::npos);
  EXPECT_TRUE(findings_.empty());
  ASSERT_TRUE(written(glm::dvec3(0.0), glm::dvec3(100000.0)));
  ASSERT_EQ(findings_.size(), 2u);
  EXPECT_NE(findings_[1].find("0.00298"), std::string::npos) << findings_[1];
}

TEST_F(PCDWriterTest, LooksToOthersLikeTheirOwn)
{
  PointBatch batch;
  SinkDescription description = manyKinds(batch);
  const std::string path = writeFile("others.pcd", "");
  PCDWriter writer(path);
  ASSERT_TRUE(writer.begin(description));
  ASSERT_TRUE(writer.append(batch));
  ASSERT_TRUE(writer.finish());
  const std::string header = bytesOfFile(path).substr(0, 400);
  EXPECT_NE(header.find("FIELDS x y z intensity rgb normal_x normal_y normal_z"), std::string::npos)
    << header;
  EXPECT_NE(header.find("SIZE 4 4 4 4 4 4 4 4 "), std::string::npos) << header;
  EXPECT_NE(header.find("TYPE F F F F F F F F "), std::string::npos) << header;
}

TEST_F(PCDWriterTest, WritesWhatTheReaderReads)
{
  expectReadAsWritten<std::uint64_t>(exact_,
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

TEST_F(PCDWriterTest, GivesFieldsNamesThatItsReaderTellsApart)
{
  expectNamesToldApart(case_);
}

TEST_F(PCDWriterTest, SaysWhyItCannotWrite)
{
  expectReasonWhenItCannotWrite(case_);
}
} // namespace
} // namespace pointfront::test
