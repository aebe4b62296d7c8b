#include "pointfront/Export/EightBitColourSink.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

namespace pointfront
{
namespace
{

/// The points that a sink was given.
struct GivenPoints
{
  SinkDescription description;
  std::vector<std::vector<std::byte>> columns;
};

class GivenPointsSink final : public PointSink
{
public:
  explicit GivenPointsSink(GivenPoints& given)
    : given_(given)
  {
  }
  Result<void> begin(const SinkDescription& description) override
  {
    given_.description = description;
    return {};
  }
  Result<void> append(const PointBatch& batch) override
  {
    given_.columns = batch.columns;
    return {};
  }
  Result<void> finish() override { return {}; }

private:
  GivenPoints& given_;
};

/// Points with intensity and 16-bit colours on their way through the sink.
class EightBitColours : public testing::Test
{
protected:
  /// Writes the points; gives the findings.
  std::vector<std::string> write(
    const std::vector<std::uint16_t>& colours, double largest, ScalarType type = ScalarType::UInt16)
  {
    SinkDescription description;
    description.schema.add({ "intensity", ScalarType::UInt16 });
    description.schema.add({ "rgb", type, 3 });
    description.largest = { 9.0, largest };
    PointBatch batch;
    batch.resize(colours.size() / 3, description.schema);
    std::memcpy(batch.columns[1].data(), colours.data(), batch.columns[1].size());
    batch.columns[0][batch.columns[0].size() - 2] = std::byte{ 7 };
    EightBitColourSink sink(std::make_unique<GivenPointsSink>(given));
    EXPECT_TRUE(sink.begin(description));
    appended = sink.append(batch);
    EXPECT_TRUE(sink.finish());
    return sink.findings();
  }
  std::vector<int> bytes() const
  {
    std::vector<int> values;
    for (const std::byte value : given.columns[1])
    {
      values.push_back(std::to_integer<int>(value));
    }
    return values;
  }

  GivenPoints given;
  Result<void> appended;
};

} // namespace

TEST_F(EightBitColours, ShiftedAndRepeatedBytesAreKept)
{
  EXPECT_TRUE(write({ 0x4b00, 0x4600, 0xff00, 0x8181, 0xffff, 0 }, 65535.0).empty());
  EXPECT_EQ(bytes(), (std::vector<int>{ 0x4b, 0x46, 0xff, 0x81, 0xff, 0 }));
  EXPECT_TRUE(appended);
  EXPECT_EQ(std::to_integer<int>(given.columns[0][2]), 7) << "others pass";
  EXPECT_EQ(given.description.schema[1].type, ScalarType::UInt8);
  EXPECT_EQ(given.description.largest[1], 255.0);
}

TEST_F(EightBitColours, WhatIsRoundedIsCounted)
{
  const std::vector<std::string> findings = write({ 0x1234, 0, 0, 0x4b00, 0, 0, 0, 0, 1 }, 65535.0);
  EXPECT_EQ(bytes(), (std::vector<int>{ 0x12, 0, 0, 0x4b, 0, 0, 0, 0, 0 }));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NE(findings[0].find("of 2 points"), std::string::npos) << findings[0];
}

TEST_F(EightBitColours, SmallColoursHaveEightBitsAlready)
{
  EXPECT_TRUE(write({ 1, 2, 255 }, 255.0).empty());
  EXPECT_EQ(bytes(), (std::vector<int>{ 1, 2, 255 }));
}

/// The ranges of a COPC file are those of its first points.
TEST_F(EightBitColours, ARangeThatWasTooSmallIsAnError)
{
  write({ 0, 0, 0, 1, 2, 256 }, 0.0);
  ASSERT_FALSE(appended);
  EXPECT_NE(appended.error().what.find("--color-depth 16"), std::string::npos);
}

TEST_F(EightBitColours, OtherTypesPass)
{
  EXPECT_TRUE(write({ 0x0201, 0x0403, 0x0605 }, 255.0, ScalarType::UInt8).empty());
  EXPECT_EQ(given.description.schema[1].type, ScalarType::UInt8);
  EXPECT_EQ(bytes(), (std::vector<int>{ 1, 2, 3 }));
}

} // namespace pointfront
