#include "FileBytes.h"
#include "LASFormat.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

namespace pointfront::test
{
namespace
{
constexpr std::size_t header14 = 375;
constexpr std::size_t header15 = 393;

/// A LAS 1.4 file as LAS 1.5 has it: two GPS times and a time offset more in the header.
std::string asVersion15(const std::string& shared, std::int16_t timeOffset)
{
  const FileBytes old(sharedData(shared.c_str()));
  FileBytes bytes(sharedData(shared.c_str()));
  bytes.resize(old.size() + header15 - header14);
  for (std::size_t i = old.size(); i-- > header14;)
  {
    bytes[i + header15 - header14] = bytes[i];
  }
  for (std::size_t i = header14; i < header15; ++i)
  {
    bytes[i] = 0;
  }
  bytes[25] = 5;
  bytes.put<std::uint16_t>(94, header15);
  bytes.put<std::uint32_t>(96, old.get<std::uint32_t>(96) + header15 - header14);
  if (old.get<std::uint64_t>(235) != 0)
  {
    bytes.put<std::uint64_t>(235, old.get<std::uint64_t>(235) + header15 - header14);
  }
  if (timeOffset != 0)
  {
    bytes.put<std::uint16_t>(6, static_cast<std::uint16_t>(old.get<std::uint16_t>(6) | 64u));
    bytes.put<std::int16_t>(391, timeOffset);
  }
  return bytes.write("version15.las");
}

TEST(LAS15, IsReadLikeLAS14)
{
  const std::string shared = "las/version_x_format/las1.4_pf6_10pts.las";
  const auto older = LASFormat().open(sharedData(shared.c_str()));
  ASSERT_TRUE(older);
  for (const std::int16_t timeOffset : std::vector<std::int16_t>{ 0, 1000, 1400 })
  {
    const auto source = LASFormat().open(asVersion15(shared, timeOffset));
    ASSERT_TRUE(source) << source.error().what;
    EXPECT_NE((*source)->description().format.find("1.5"), std::string::npos);
    PointBatch one;
    PointBatch other;
    ASSERT_TRUE((*older)->read(0, one));
    ASSERT_TRUE((*source)->read(0, other));
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.columns, other.columns);
    EXPECT_EQ((*source)->description().warnings.size() - (*older)->description().warnings.size(),
      timeOffset == 1400 ? 1u : 0u);
  }
}

TEST(LAS15, IsTheLastVersion)
{
  FileBytes bytes(sharedData("las/version_x_format/las1.4_pf6_10pts.las"));
  bytes[25] = 6;
  EXPECT_FALSE(LASFormat().open(bytes.write("version16.las")));
}

TEST(COPC, WithChunksOfNoFixedSizeIsReadByItsTable)
{
  const std::string shared = sharedData("copc/1.2-with-color.copc.laz");
  FileBytes bytes(shared);
  const std::size_t record = bytes.find("laszip encoded") - 2;
  bytes.put<std::uint32_t>(record + 54 + 12, 0u);
  const auto source = LASFormat().open(bytes.write("zero.copc.laz"));
  ASSERT_TRUE(source) << source.error().what;
  const auto whole = LASFormat().open(shared);
  ASSERT_TRUE(whole);
  EXPECT_EQ((*source)->description().pointCount, 1065u);
  ASSERT_EQ((*source)->chunkCount(), (*whole)->chunkCount());
  for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
  {
    PointBatch one;
    PointBatch other;
    ASSERT_TRUE((*source)->read(chunk, one));
    ASSERT_TRUE((*whole)->read(chunk, other));
    EXPECT_EQ(one.positions, other.positions);
  }
}
} // namespace
} // namespace pointfront::test
