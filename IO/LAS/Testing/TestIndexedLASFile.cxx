#include "FileBytes.h"
#include "FilesInTheMaking.h"
#include "IndexedLASFile.h"
#include "LASIndexing.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <sys/stat.h>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;

const char* const trimmed = "las/real/autzen_trim.las"; // 110,000 points, LAS 1.2 format 3

ColumnSelection everyColumn(const AttributeSchema& schema)
{
  ColumnSelection columns(schema.size());
  std::iota(columns.begin(), columns.end(), 0u);
  return columns;
}

/// A copy of a public file in the test's own folder.
std::string copyOf(const char* shared, const std::string& name)
{
  return FileBytes(sharedData(shared)).write(name);
}

LASIndexReport indexOrFail(const std::string& las, const std::string& side)
{
  LASIndexOptions options;
  options.leafPoints = 1000;
  options.threads = 2;
  options.overwrite = true;
  Result<LASIndexReport> report = indexLASFile(las, side, options);
  EXPECT_TRUE(report) << report.error().what;
  return report ? *report : LASIndexReport{};
}

std::shared_ptr<const IndexedLASFile> openIndexed(const std::string& side)
{
  auto indexed = IndexedLASFile::open(side);
  EXPECT_TRUE(indexed) << indexed.error().what;
  return indexed ? *indexed : nullptr;
}

/// Position and attributes of each point as one text of bytes, sorted.
class PointSet
{
public:
  void add(const glm::dvec3& position, const std::vector<std::vector<std::byte>>& columns,
    const AttributeSchema& schema, std::size_t point)
  {
    std::string bytes(reinterpret_cast<const char*>(&position), sizeof position);
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      const std::size_t width = schema[c].bytes();
      bytes.append(reinterpret_cast<const char*>(columns[c].data() + point * width), width);
    }
    points_.push_back(std::move(bytes));
  }
  const std::vector<std::string>& sorted()
  {
    std::sort(points_.begin(), points_.end());
    return points_;
  }

private:
  std::vector<std::string> points_;
};

std::vector<std::string> pointsOf(const StoredCloud& cloud)
{
  PointSet set;
  const StoreDescription& description = cloud.description();
  const ColumnSelection columns = everyColumn(description.schema);
  for (NodeIndex i = 0; i < cloud.hierarchy()->nodeCount(); ++i)
  {
    const auto node = cloud.read(i, columns);
    EXPECT_TRUE(node) << node.error().what;
    const auto count = static_cast<std::uint32_t>(node->size());
    EXPECT_EQ(node->bytes(), cloud.decodedBytes(i, count, columns));
    for (std::size_t p = 0; p < node->size(); ++p)
    {
      set.add(description.grid.toWorld(node->origin + GridPosition(node->positions[p])),
        node->columns, description.schema, p);
    }
  }
  return set.sorted();
}

std::vector<std::string> pointsOf(const PointSource& source)
{
  PointSet set;
  const PointBatch batch = readAll(source);
  for (std::size_t p = 0; p < batch.size(); ++p)
  {
    set.add(batch.positions[p], batch.columns, source.description().schema, p);
  }
  return set.sorted();
}

std::string refusal(const std::string& side, Error::Kind kind)
{
  const auto opened = IndexedLASFile::open(side);
  EXPECT_FALSE(opened) << side << " opens";
  EXPECT_TRUE(opened || opened.error().kind == kind) << opened.error().what;
  return opened ? "" : opened.error().what;
}

bool has(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

TEST(IndexedLASFile, GivesEveryPointOfEveryFormatOnce)
{
  for (const char* name :
    { trimmed, "las/real/1.2-with-color.las", "las/version_x_format/las1.4_pf10_1024pts_random.las",
      "las/version_x_format/las1.2_pf3_10pts.las" })
  {
    const std::string las = copyOf(name, "points.las");
    const LASIndexReport report = indexOrFail(las, las + lasIndexSuffix);
    const auto indexed = openIndexed(las + lasIndexSuffix);
    ASSERT_NE(indexed, nullptr);
    const auto source = openOrFail(las);
    EXPECT_EQ(report.points, source->description().pointCount);
    EXPECT_EQ(pointsOf(*indexed), pointsOf(*source)) << name;
    const auto verified = indexed->verify();
    ASSERT_TRUE(verified);
    EXPECT_TRUE(verified->ok) << verified->firstError;
    EXPECT_EQ(verified->pointsChecked, report.points);
    EXPECT_EQ(indexed->description().structure, "inplace");
    EXPECT_EQ(indexed->description().metadata.size(), source->description().metadata.size());
  }
}

TEST(IndexedLASFile, TheFileIsNotTouchedAndTheSideFileIsSmall)
{
  const std::string las = copyOf(trimmed, "points.las");
  const FileBytes before(las);
  const LASIndexReport report = indexOrFail(las, las + lasIndexSuffix);
  FileBytes after(las);
  ASSERT_EQ(after.size(), before.size());
  bool same = true;
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    same = same && after[i] == before.get<std::uint8_t>(i);
  }
  EXPECT_TRUE(same);
  EXPECT_EQ(fs::file_size(las + lasIndexSuffix), report.bytesWritten);
  EXPECT_LT(report.bytesWritten, report.points); // below a byte a point
  EXPECT_TRUE(filesInTheMaking(las + lasIndexSuffix).empty());
}

TEST(IndexedLASFile, ColumnsAreTheSameAloneAndTogether)
{
  const std::string las = copyOf(trimmed, "points.las");
  indexOrFail(las, las + lasIndexSuffix);
  const auto indexed = openIndexed(las + lasIndexSuffix);
  ASSERT_NE(indexed, nullptr);
  const AttributeSchema& schema = indexed->description().schema;
  const auto whole = indexed->read(5, everyColumn(schema));
  ASSERT_TRUE(whole);
  for (std::uint32_t c = 0; c < schema.size(); ++c)
  {
    const auto alone = indexed->read(5, { c });
    ASSERT_TRUE(alone);
    EXPECT_EQ(alone->columns[0], whole->columns[c]);
    EXPECT_EQ(alone->positions, whole->positions);
  }
}

TEST(IndexedLASFile, NoPointsAndOne)
{
  FileBytes bytes(sharedData(trimmed));
  const auto points = bytes.get<std::uint32_t>(96);
  for (const std::uint32_t count : { 0u, 1u })
  {
    bytes.put<std::uint32_t>(107, count);
    bytes.resize(points + count * bytes.get<std::uint16_t>(105));
    const std::string las = bytes.write("few.las");
    EXPECT_EQ(indexOrFail(las, las + lasIndexSuffix).points, count);
    const auto indexed = openIndexed(las + lasIndexSuffix);
    ASSERT_NE(indexed, nullptr);
    EXPECT_EQ(indexed->hierarchy()->nodeCount(), count);
    EXPECT_EQ(indexed->hierarchy()->roots().size(), count);
    const auto verified = indexed->verify();
    EXPECT_TRUE(verified && verified->ok) << verified->firstError;
    bytes = FileBytes(sharedData(trimmed));
  }
}

TEST(IndexedLASFile, AnotherFileIsRefusedWithWhatDiffers)
{
  const std::string las = copyOf(trimmed, "points.las");
  const std::string side = las + lasIndexSuffix;
  indexOrFail(las, side);
  FileBytes bytes(las);
  const auto points = bytes.get<std::uint32_t>(96);

  bytes[30] ^= 1; // in the system identifier
  bytes.write("points.las");
  EXPECT_TRUE(has(refusal(side, Error::Kind::Corrupt), "header"));
  bytes[30] ^= 1;
  bytes[points + 5] ^= 1;
  bytes.write("points.las");
  EXPECT_TRUE(has(refusal(side, Error::Kind::Corrupt), "first or last points"));
  bytes[points + 5] ^= 1;
  bytes.resize(bytes.size() - 100);
  bytes.write("points.las");
  EXPECT_TRUE(has(refusal(side, Error::Kind::Corrupt), "size in bytes"));
  fs::remove(las);
  EXPECT_TRUE(has(refusal(side, Error::Kind::NotFound), "not there"));
}

TEST(IndexedLASFile, VerifyFindsAPointThatMovedInTheMiddle)
{
  const std::string las = copyOf(trimmed, "points.las");
  const std::string side = las + lasIndexSuffix;
  indexOrFail(las, side);
  FileBytes bytes(las);
  const std::size_t middle =
    bytes.get<std::uint32_t>(96) + std::size_t(55000) * bytes.get<std::uint16_t>(105);
  bytes.put<std::int32_t>(middle, bytes.get<std::int32_t>(middle) + 100000);
  bytes.write("points.las");
  const auto indexed = openIndexed(side);
  ASSERT_NE(indexed, nullptr);
  const auto verified = indexed->verify();
  ASSERT_TRUE(verified);
  EXPECT_FALSE(verified->ok);
  EXPECT_TRUE(has(verified->firstError, "outside its box")) << verified->firstError;
}

TEST(IndexedLASFile, TheFolderMayMoveAndTheSideFileMayLieElsewhere)
{
  const std::string folder = outputFolder() + "/a";
  fs::remove_all(outputFolder() + "/b");
  fs::create_directories(folder + "/sides");
  const std::string las = folder + "/points.las";
  fs::copy_file(sharedData(trimmed), las, fs::copy_options::overwrite_existing);
  indexOrFail(las, folder + "/sides/points.pfindex");
  fs::rename(folder, outputFolder() + "/b");
  const auto indexed = openIndexed(outputFolder() + "/b/sides/points.pfindex");
  ASSERT_NE(indexed, nullptr);
  EXPECT_EQ(indexed->description().pointCount, 110000u);
}

// A side file may come from anywhere. A pipe never answers who opens it to read.
TEST(IndexedLASFile, APipeInPlaceOfTheFileIsRefusedAndNotOpened)
{
  const std::string las = copyOf(trimmed, "piped.las");
  const std::string side = outputFolder() + "/piped.pfindex";
  indexOrFail(las, side);
  fs::remove(las);
  ASSERT_EQ(mkfifo(las.c_str(), 0600), 0);
  const auto indexed = IndexedLASFile::open(side);
  fs::remove(las);
  ASSERT_FALSE(indexed);
  EXPECT_TRUE(has(indexed.error().what, "which is no file")) << indexed.error().what;
}

TEST(LASIndexing, RefusesWhatItCannotIndex)
{
  const std::string laz = sharedData("laz/extrabytes.laz");
  const auto compressed = indexLASFile(laz, outputFolder() + "/laz.pfindex", {});
  ASSERT_FALSE(compressed);
  EXPECT_EQ(compressed.error().kind, Error::Kind::Unsupported);
  EXPECT_TRUE(has(compressed.error().what, "decompress"));
  EXPECT_FALSE(fs::exists(outputFolder() + "/laz.pfindex"));

  const std::string las = copyOf(trimmed, "points.las");
  const auto itself = indexLASFile(las, las, {});
  ASSERT_FALSE(itself);
  EXPECT_EQ(itself.error().kind, Error::Kind::BadArgument);
  EXPECT_EQ(fs::file_size(las), fs::file_size(sharedData(trimmed)));
  EXPECT_EQ(indexLASFile(las + ".none", las + ".side", {}).error().kind, Error::Kind::NotFound);
}

TEST(LASIndexing, CancelledLeavesWhatWasThere)
{
  const std::string las = copyOf(trimmed, "points.las");
  const std::string side = las + lasIndexSuffix;
  indexOrFail(las, side);
  const auto written = fs::last_write_time(side);
  LASIndexOptions options;
  options.overwrite = true;
  const auto cancelled = indexLASFile(las, side, options, [](const Progress&) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, Error::Kind::Cancelled);
  EXPECT_EQ(fs::last_write_time(side), written);
  EXPECT_TRUE(filesInTheMaking(side).empty());
}

TEST(LASIndexing, AFileThatWasCutShortIsIndexedAsFarAsItGoes)
{
  FileBytes bytes(sharedData(trimmed));
  bytes.resize(bytes.size() - 34 * 1000 - 3);
  const std::string las = bytes.write("short.las");
  const LASIndexReport report = indexOrFail(las, las + lasIndexSuffix);
  EXPECT_EQ(report.points, 108999u);
  ASSERT_EQ(report.warnings.size(), 1u);
  const auto indexed = openIndexed(las + lasIndexSuffix);
  ASSERT_NE(indexed, nullptr);
  const auto verified = indexed->verify();
  EXPECT_TRUE(verified && verified->ok) << verified->firstError;
}
} // namespace
} // namespace pointfront::test
