#include "FileBytes.h"
#include "LASFormat.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <laszip/laszip_api.h>

#include <cstdint>
#include <string>

namespace pointfront::test
{
namespace
{
/// A LAZ file with so many points, each a chunk of its own.
std::string chunksOfOnePoint(std::uint32_t points)
{
  const std::string path = outputFolder() + "/chunks.laz";
  laszip_POINTER writer = nullptr;
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  EXPECT_EQ(laszip_create(&writer), 0);
  EXPECT_EQ(laszip_get_header_pointer(writer, &header), 0);
  header->version_major = 1;
  header->version_minor = 2;
  header->header_size = 227;
  header->offset_to_point_data = 227;
  header->point_data_format = 0;
  header->point_data_record_length = 20;
  header->number_of_point_records = points;
  header->x_scale_factor = header->y_scale_factor = header->z_scale_factor = 0.01;
  EXPECT_EQ(laszip_set_chunk_size(writer, 1), 0);
  EXPECT_EQ(laszip_open_writer(writer, path.c_str(), 1), 0);
  EXPECT_EQ(laszip_get_point_pointer(writer, &point), 0);
  for (std::uint32_t i = 0; i < points; ++i)
  {
    point->X = static_cast<laszip_I32>(i % 1000);
    point->Y = static_cast<laszip_I32>(i / 1000);
    EXPECT_EQ(laszip_set_point(writer, point), 0);
    EXPECT_EQ(laszip_write_point(writer), 0);
  }
  EXPECT_EQ(laszip_close_writer(writer), 0);
  EXPECT_EQ(laszip_destroy(writer), 0);
  return path;
}

TEST(LAZChunkTable, ManyChunksBehindTheCountAreDropped)
{
  constexpr std::uint32_t points = 60000; // counting them anew for each one would take 9 s
  FileBytes bytes(chunksOfOnePoint(points));
  bytes.put<std::uint32_t>(107, 1); // the header's count
  const std::string path = bytes.write("one.laz");
  const auto source = LASFormat().open(path);
  ASSERT_TRUE(source) << source.error().what;
  ASSERT_EQ((*source)->description().warnings.size(), 1u);
  EXPECT_NE((*source)->description().warnings[0].find("59999 of 60000 chunks lie behind them"),
    std::string::npos)
    << (*source)->description().warnings[0];
  EXPECT_EQ(readAll(**source).size(), 1u);
}

TEST(LAZChunkTable, ACountInTheMiddleOfManyChunksKeepsThem)
{
  FileBytes bytes(chunksOfOnePoint(1000));
  bytes.put<std::uint32_t>(107, 600);
  const auto source = LASFormat().open(bytes.write("some.laz"));
  ASSERT_TRUE(source) << source.error().what;
  EXPECT_EQ((*source)->description().pointCount, 600u);
  EXPECT_EQ(readAll(**source).size(), 600u);
}

} // namespace
} // namespace pointfront::test
