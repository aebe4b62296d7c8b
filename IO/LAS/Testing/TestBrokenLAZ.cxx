#include "FileBytes.h"
#include "LASFormat.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cstdint>
#include <functional>

namespace pointfront::test
{
namespace
{
const char* const chunked = "laz/autzen_trim.laz"; // format 3, chunks of 50,000
const char* const layered = "laz/las1.4_pf8_random.laz"; // format 8, 4 chunks of 256
const char* const variable = "copc/1.2-with-color.copc.laz";
const char* const pointwise = "laz/simple-laszip-compressor-version-1.2r0.laz";

/// Places in a LAZ file.
std::size_t compressionRecord(const FileBytes& bytes)
{
  return bytes.find("laszip encoded") + 52; // behind the rest of the record's header
}
std::size_t firstPoint(const FileBytes& bytes)
{
  return bytes.get<std::uint32_t>(96);
}
std::size_t chunkTable(const FileBytes& bytes)
{
  return bytes.get<std::uint64_t>(firstPoint(bytes));
}

std::string broken(const char* file, const std::function<void(FileBytes&)>& change)
{
  FileBytes bytes(sharedData(file));
  change(bytes);
  return bytes.write("broken.laz");
}

void expectArchiveRefused(const std::string& path, Error::Kind kind, const std::string& words)
{
  const auto source = LASFormat().open(path);
  ASSERT_FALSE(source) << "was opened";
  EXPECT_EQ(source.error().kind, kind) << source.error().what;
  EXPECT_NE(source.error().what.find(words), std::string::npos) << source.error().what;
}

/// Opens with one warning of these words and `points` points that can all be read.
void expectArchiveSurvived(const std::string& path, std::uint64_t points, const std::string& words)
{
  const auto source = openOrFail(path);
  ASSERT_TRUE(source);
  ASSERT_EQ(source->description().warnings.size(), 1u);
  EXPECT_NE(source->description().warnings[0].find(words), std::string::npos)
    << source->description().warnings[0];
  EXPECT_EQ(source->description().pointCount, points);
  EXPECT_EQ(readAll(*source).size(), points);
}

TEST(BrokenLAZ, ALyingCompressionRecordIsRefusedBeforeLASzipSeesIt)
{
  struct Case
  {
    const char* file;
    std::size_t at; ///< in the compression record
    std::uint16_t value;
    Error::Kind kind;
    const char* words;
  };
  const Case cases[] = {
    { chunked, 0, 7, Error::Kind::Unsupported, "compressor 7" },
    { chunked, 0, 3, Error::Kind::Unsupported, "compressor 3" },
    { layered, 0, 2, Error::Kind::Unsupported, "compressor 2" },
    { chunked, 2, 1, Error::Kind::Unsupported, "coder 1" },
    { chunked, 32, 65535, Error::Kind::BadFormat, "too few for its 65535 items" },
    { chunked, 32, 2, Error::Kind::BadFormat, "compressed in 3 items" },
    { chunked, 34, 0, Error::Kind::BadFormat, "compressed item 1 is type 0 of 20 bytes" },
    { layered, 48, 60000, Error::Kind::BadFormat, "compressed item 3 is type 14 of 60000" },
  };
  for (const Case& c : cases)
  {
    SCOPED_TRACE(c.words);
    const std::string path = broken(
      c.file, [&](FileBytes& b) { b.put<std::uint16_t>(compressionRecord(b) + c.at, c.value); });
    expectArchiveRefused(path, c.kind, c.words);
  }
  expectArchiveRefused(
    broken(chunked, [](FileBytes& b) { b.put<std::uint32_t>(compressionRecord(b) + 12, 0); }),
    Error::Kind::BadFormat, "chunks of 0 points");
  expectArchiveRefused(broken(chunked, [](FileBytes& b) { b[b.find("laszip encoded")] = 'x'; }),
    Error::Kind::BadFormat, "record \"laszip encoded\" that says how is missing");
}

TEST(BrokenLAZ, ACountBeyondItsChunksIsRefused)
{
  const std::string path =
    broken(chunked, [](FileBytes& b) { b.put<std::uint32_t>(107, 4294967295u); });
  expectArchiveRefused(path, Error::Kind::BadFormat, "its 3 chunks hold at most 150000");
}

TEST(BrokenLAZ, ACountBelowItsChunksIsAWarning)
{
  const auto one = [](FileBytes& b) { b.put<std::uint32_t>(107, 50000); };
  expectArchiveSurvived(broken(chunked, one), 50000, "2 of 3 chunks lie behind them");
  const auto fewer = [](FileBytes& b)
  {
    b.put<std::uint64_t>(247, 1000);
    b.put<std::uint32_t>(107, 0);
  };
  expectArchiveSurvived(broken(variable, fewer), 1065, "the chunk table 1065");
}

TEST(BrokenLAZ, WithoutItsChunkTableIsWalkedThrough)
{
  const std::int64_t nowhere[] = { 0, std::int64_t{ 1 } << 62, -2 };
  for (const std::int64_t place : nowhere)
  {
    const auto lose = [&](FileBytes& b) { b.put<std::int64_t>(firstPoint(b), place); };
    expectArchiveSurvived(broken(chunked, lose), 110000, "0 of 110000 points are missing");
    expectArchiveSurvived(broken(layered, lose), 1024, "0 of 1024 points are missing");
    expectArchiveSurvived(broken(variable, lose), 1065, "0 of 1065 points are missing");
  }
  expectArchiveSurvived(
    broken(chunked, [](FileBytes& b) { b.put<std::uint32_t>(chunkTable(b) + 4, 4294967295u); }),
    110000, "chunk table is missing or damaged");
  expectArchiveSurvived(
    broken(layered, [](FileBytes& b) { b.put<std::uint32_t>(chunkTable(b), 9); }), 1024,
    "chunk table is missing or damaged");
}

TEST(BrokenLAZ, ThatWasWrittenToAPipeHasItsTablePlaceAtTheEnd)
{
  FileBytes bytes(sharedData("laz/simple.laz"));
  const std::uint64_t table = chunkTable(bytes);
  bytes.put<std::int64_t>(firstPoint(bytes), -1);
  const std::size_t end = bytes.size();
  bytes.resize(end + 8);
  bytes.put<std::uint64_t>(end, table);
  const auto source = openOrFail(bytes.write("pipe.laz"));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().warnings, std::vector<std::string>());
  EXPECT_EQ(readAll(*source).size(), 1065u);
}

TEST(BrokenLAZ, CutShortGivesWhatIsSound)
{
  const auto whole = openOrFail(sharedData(chunked));
  ASSERT_TRUE(whole);
  const PointBatch all = readAll(*whole);
  const auto source = openOrFail(broken(chunked, [](FileBytes& b) { b.resize(b.size() / 2); }));
  ASSERT_TRUE(source);
  const std::uint64_t points = source->description().pointCount;
  EXPECT_GT(points, 50000u);
  EXPECT_LT(points, 60000u);
  ASSERT_EQ(source->description().warnings.size(), 1u);
  EXPECT_NE(source->description().warnings[0].find(
              std::to_string(110000 - points) + " of 110000 points are missing"),
    std::string::npos);
  const PointBatch part = readAll(*source);
  ASSERT_EQ(part.size(), points);
  EXPECT_TRUE(std::equal(part.positions.begin(), part.positions.end(), all.positions.begin()));

  expectArchiveSurvived(broken(layered, [](FileBytes& b) { b.resize(b.size() / 2); }), 256,
    "768 of 1024 points are missing");
  expectArchiveRefused(broken(layered, [](FileBytes& b) { b.resize(firstPoint(b) + 100); }),
    Error::Kind::Truncated, "holds not one that is sound");
  const auto old = openOrFail(broken(pointwise, [](FileBytes& b) { b.resize(b.size() / 2); }));
  ASSERT_TRUE(old);
  EXPECT_GT(old->description().pointCount, 400u);
  EXPECT_LT(old->description().pointCount, 700u);
  EXPECT_EQ(readAll(*old).size(), old->description().pointCount);
}

TEST(BrokenLAZ, ADamagedChunkIsAnErrorWithItsPlaceAndTheOthersAreRead)
{
  const std::string path = broken(layered,
    [](FileBytes& b)
    {
      // Layer sizes stay, so only the code of the last chunk contradicts itself.
      for (std::size_t at = chunkTable(b) - 3000; at < chunkTable(b); ++at)
      {
        b[at] = 0xFF;
      }
    });
  const auto source = LASFormat().open(path);
  ASSERT_TRUE(source) << source.error().what;
  PointBatch batch;
  const Result<void> done = (*source)->read((*source)->chunkCount() - 1, batch);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, Error::Kind::BadFormat);
  EXPECT_NE(done.error().what.find("the compressed chunk of 256 points at byte"), std::string::npos)
    << done.error().what;
}

/// LASzip follows changes between sequences of GPS times by recursion: such runs made it endless.
TEST(BrokenLAZ, RunsOfOnesInTheCodeAreErrorsInEveryFormat)
{
  const char* const files[] = { "laz/autzen_trim.laz", "laz/lazperf_point-time.las.laz",
    "laz/simple.laz", "laz/las1.4_pf6_random.laz", "classified/lidarprod_rgb_buildings_71k.laz" };
  for (const char* file : files)
  {
    for (const std::size_t run : { 64, 512, 4096, 65536 })
    {
      for (const std::size_t third : { 0, 1, 2 })
      {
        const std::string path = broken(file,
          [&](FileBytes& b)
          {
            const std::size_t begin = firstPoint(b) + 108, end = b.size() - 1;
            const std::size_t from = begin + third * (end - begin) / 3;
            for (std::size_t at = from; at < std::min(from + run, end); ++at)
            {
              b[at] = 0xFF;
            }
          });
        const auto source = LASFormat().open(path);
        PointBatch batch;
        for (std::uint64_t c = 0; source && c < (*source)->chunkCount(); ++c)
        {
          const Result<void> done = (*source)->read(c, batch);
          EXPECT_TRUE(done || done.error().kind == Error::Kind::BadFormat) << done.error().what;
        }
      }
    }
  }
}
} // namespace
} // namespace pointfront::test
