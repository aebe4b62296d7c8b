#include "FileBytes.h"
#include "LASFormat.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>

namespace pointfront::test
{
namespace
{
/// A file that must be refused, and the words that must say why.
struct Refused
{
  const char* path;
  Error::Kind kind;
  const char* words;
};

const Refused refusedFiles[] = {
  { "derived_hostile/las_offset_to_points_past_eof.las", Error::Kind::Truncated,
    "points should begin at byte 10000000" },
  { "derived_hostile/las_record_length_0.las", Error::Kind::BadFormat,
    "point records of 0 bytes (byte 105)" },
  { "derived_hostile/las_point_format_63.las", Error::Kind::Unsupported,
    "point format 63 (byte 104) does not exist" },
  { "derived_hostile/las_scale_zero.las", Error::Kind::BadFormat, "the x scale is 0 (byte 131)" },
  { "derived_hostile/las_truncated_header_200_bytes.las", Error::Kind::Truncated,
    "the file ends at byte 200, inside its header" },
  { "las/broken_real/1.2-no-points.las", Error::Kind::Truncated, "promises 1065 points" },
  { "las/broken_real/broken_size.laz", Error::Kind::Unsupported,
    "compressed item 1 (type 6 of 20 bytes) has version 6" },
  { "las/broken_real/broken_type.laz", Error::Kind::BadFormat,
    "compressed item 2 is type 22 of 8 bytes" },
};

/// A file that is read as far as it is sound, and the words of its one warning.
struct Survived
{
  const char* path;
  std::uint64_t points;
  const char* words;
};

const Survived survivedFiles[] = {
  { "derived_hostile/las_count_4294967295.las", 100,
    "4294967195 of 4294967295 points are missing" },
  { "derived_hostile/las_truncated_mid_record.las", 57, "43 of 100 points are missing" },
  { "derived_hostile/las_bbox_inverted.las", 100, "bounding box has a maximum x of -1" },
  { "las/broken_real/1.2-with-color-clipped.las", 1064, "1 of 1065 points are missing" },
  { "las/broken_real/bad_vlr_count.las", 10, "1 of these records were lost" },
};

void expectRefused(const std::string& path, Error::Kind kind, const std::string& words)
{
  const auto source = LASFormat().open(path);
  ASSERT_FALSE(source) << path << " was opened";
  EXPECT_EQ(source.error().kind, kind) << source.error().what;
  EXPECT_NE(source.error().what.find(words), std::string::npos) << source.error().what;
  EXPECT_EQ(source.error().what.find(path), 0u) << "names the file first";
}

void expectSurvived(const std::string& path, std::uint64_t points, const std::string& words)
{
  const auto source = openOrFail(path);
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().pointCount, points);
  EXPECT_EQ(readAll(*source).size(), points);
  const std::vector<std::string>& warnings = source->description().warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
}

TEST(BrokenLAS, IsRefusedWithItsReason)
{
  for (const Refused& file : refusedFiles)
  {
    SCOPED_TRACE(file.path);
    expectRefused(sharedData(file.path), file.kind, file.words);
  }
}

TEST(BrokenLAS, IsReadAsFarAsItIsSound)
{
  for (const Survived& file : survivedFiles)
  {
    SCOPED_TRACE(file.path);
    expectSurvived(sharedData(file.path), file.points, file.words);
  }
}

TEST(BrokenLAS, MissingFilesAndFoldersAreErrors)
{
  EXPECT_EQ(LASFormat().open("no/such.las").error().kind, Error::Kind::NotFound);
  EXPECT_EQ(LASFormat().open(outputFolder()).error().kind, Error::Kind::Unreadable);
  EXPECT_FALSE(LASFormat().accepts(outputFolder()));
  FileBytes empty(sharedData("las/real/prec3.las"));
  empty.resize(0);
  const std::string path = empty.write("empty.las");
  EXPECT_FALSE(LASFormat().accepts(path));
  expectRefused(path, Error::Kind::BadFormat, "the file is empty");
}

TEST(BrokenLAS, NaNTimeIsData)
{
  const auto source = openOrFail(sharedData("las/broken_real/gps-time-nan.las"));
  ASSERT_TRUE(source);
  const auto times = valuesOf(readAll(*source), source->description().schema, "gps_time");
  ASSERT_EQ(times.size(), 1u);
  EXPECT_TRUE(std::isnan(times[0]));
  EXPECT_EQ(source->description().warnings, std::vector<std::string>());
}

/// One field of a sound file, changed.
struct Change
{
  const char* file;
  std::function<void(FileBytes&)> change;
};

template <typename T>
std::function<void(FileBytes&)> put(std::size_t at, T value)
{
  return [at, value](FileBytes& bytes) { bytes.put<T>(at, value); };
}

const char* const las12 = "las/real/1.2-with-color.las";
const char* const las14 = "las/real/1_4_w_evlr.las";

TEST(BrokenLAS, LyingHeaderFieldsAreRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  struct Case
  {
    Change change;
    Error::Kind kind;
    const char* words;
  };
  const Case cases[] = {
    { { las12, put<std::uint8_t>(24, 2) }, Error::Kind::Unsupported, "LAS version 2.2 (byte 24)" },
    { { las12, put<std::uint8_t>(25, 6) }, Error::Kind::Unsupported, "LAS version 1.6" },
    { { las12, put<std::uint16_t>(94, 0) }, Error::Kind::BadFormat, "header of 0 bytes" },
    { { las12, put<std::uint16_t>(94, 65535) }, Error::Kind::Truncated, "inside its header" },
    { { las14, put<std::uint16_t>(94, 300) }, Error::Kind::BadFormat, "too short for LAS 1.4" },
    { { las12, put<std::uint32_t>(96, 3) }, Error::Kind::BadFormat, "points at byte 3" },
    { { las12, put<std::uint8_t>(104, 0x43) }, Error::Kind::Unsupported, "older than 1.0" },
    { { las12, put<std::uint8_t>(104, 0x83) }, Error::Kind::BadFormat, "\"laszip encoded\"" },
    { { las12, put<std::uint16_t>(105, 33) }, Error::Kind::BadFormat, "which needs 34" },
    { { las12, put<double>(139, nan) }, Error::Kind::BadFormat, "the y scale is nan" },
    { { las12, put<double>(147, -0.01) }, Error::Kind::BadFormat, "the z scale is -0.01" },
    { { las12, put<double>(155, infinity) }, Error::Kind::BadFormat, "the x offset is inf" },
    { { las12, put<double>(131, 1e50) }, Error::Kind::BadFormat,
      "may reach beyond 1000000000000000" },
    { { las12, put<double>(163, 1e30) }, Error::Kind::BadFormat, "cannot hold in steps" },
  };
  for (const Case& c : cases)
  {
    SCOPED_TRACE(c.words);
    FileBytes bytes(sharedData(c.change.file));
    c.change.change(bytes);
    expectRefused(bytes.write("field.las"), c.kind, c.words);
  }
}

TEST(BrokenLAS, LyingCountsOfRecordsAndPointsDoNotHurt)
{
  const std::uint64_t huge = std::numeric_limits<std::uint64_t>::max();
  struct Case
  {
    Change change;
    std::uint64_t points;
    const char* words;
  };
  const Case cases[] = {
    { { las12, put<std::uint32_t>(100, 1069128089u) }, 1065, "1069128089 of these records" },
    { { las12, put<std::uint32_t>(107, 4294967295u) }, 1065, "4294966230 of 4294967295 points" },
    { { las14, put<std::uint64_t>(235, huge) }, 1000, "1 of these records were lost" },
    { { las14, put<std::uint64_t>(235, 400) }, 1000, "1 records were lost" },
    { { las14, put<std::uint32_t>(243, 4294967295u) }, 1000, "4294967294 of these records" },
    { { "las/real/test1_4.las", put<std::uint64_t>(247, 999) }, 999, "two point counts, 1000" },
    { { las12, put<std::uint32_t>(107, 1000u) }, 1000, "room for 65 more" },
  };
  for (const Case& c : cases)
  {
    SCOPED_TRACE(c.words);
    FileBytes bytes(sharedData(c.change.file));
    c.change.change(bytes);
    expectSurvived(bytes.write("count.las"), c.points, c.words);
  }
}

TEST(BrokenLAS, APointCountThatReachesIntoTheExtendedRecordsStopsBeforeThem)
{
  FileBytes bytes(sharedData(las14));
  bytes.put<std::uint64_t>(247, std::numeric_limits<std::uint64_t>::max() / 64);
  bytes.put<std::uint32_t>(107, 0);
  expectSurvived(bytes.write("long.las"), 1000, "points are missing: their bytes end at byte");
}

TEST(BrokenLAS, IsReadOrRefusedWhereverItIsCut)
{
  const FileBytes whole(sharedData("las/real/extrabytes.las"));
  for (std::size_t size = 0; size < whole.size(); size += 211)
  {
    FileBytes bytes = whole;
    bytes.resize(size);
    const auto source = LASFormat().open(bytes.write("cut.las"));
    if (source)
    {
      const std::uint64_t points = (*source)->description().pointCount;
      EXPECT_EQ(points, (size - whole.get<std::uint32_t>(96)) / whole.get<std::uint16_t>(105));
      EXPECT_EQ(readAll(**source).size(), points);
      EXPECT_EQ((*source)->description().warnings.size(), 1u);
    }
    else
    {
      EXPECT_LT(size, whole.get<std::uint32_t>(96) + whole.get<std::uint16_t>(105));
    }
  }
}

/// Random damage: whatever happens, it ends with points or an Error. The sanitizer presets make
/// this a search for memory faults.
void damage(const char* file, std::size_t within, int rounds)
{
  const FileBytes whole(sharedData(file));
  for (int round = 0; round < rounds; ++round)
  {
    SCOPED_TRACE(std::string(file) + ", seed " + std::to_string(round));
    std::mt19937 random(static_cast<std::mt19937::result_type>(round));
    FileBytes bytes = whole;
    const std::size_t end = std::min(within, bytes.size());
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
    {
      bytes[random() % end] = static_cast<std::uint8_t>(random());
    }
    const auto source = LASFormat().open(bytes.write("damaged.las"));
    if (!source)
    {
      EXPECT_NE(source.error().what, "");
      continue;
    }
    PointBatch batch;
    std::uint64_t sum = 0;
    for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
    {
      sum += (*source)->chunkPoints(chunk);
      const Result<void> done = (*source)->read(chunk, batch);
      EXPECT_TRUE(!done || batch.size() == (*source)->chunkPoints(chunk));
    }
    EXPECT_EQ(sum, (*source)->description().pointCount);
  }
}

TEST(BrokenLAS, SurvivesRandomDamage)
{
  damage("las/real/extrabytes.las", 3000, 300);
  damage(las14, 1500, 300);
}

TEST(BrokenLAZ, SurvivesRandomDamageOfItsBeginning)
{
  damage("laz/simple.laz", 700, 150);
  damage("laz/las1.4_pf8_random.laz", 1200, 150);
  damage("copc/1.2-with-color.copc.laz", 2200, 100);
}

TEST(BrokenLAZ, SurvivesRandomDamageAnywhere)
{
  const std::size_t all = std::numeric_limits<std::size_t>::max();
  damage("laz/simple.laz", all, 60);
  damage("laz/extrabytes.laz", all, 60);
  damage("laz/las1.4_pf8_random.laz", all, 60);
  damage("laz/simple-laszip-compressor-version-1.2r0.laz", all, 60);
  damage("copc/1.2-with-color.copc.laz", all, 60);
}
} // namespace
} // namespace pointfront::test
