#include "FileBytes.h"
#include "FilesInTheMaking.h"
#include "IndexedLASFile.h"
#include "LASIndexing.h"
#include "LASWriter.h"
#include "SourcePoints.h"

#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/Neighbourhood/PointColumn.h"
#include "pointfront/Points/NormalAttribute.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;

/// A normal that tells the point's time, so that one beside another point is seen.
PackedNormal normalOf(double time)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &time, sizeof bits);
  bits *= 0x9e3779b97f4a7c15ull;
  return { static_cast<std::int16_t>(bits >> 40 & 0x3fff),
    static_cast<std::int16_t>(bits >> 20 & 0x3fff), static_cast<std::int16_t>(bits >> 50) };
}

class TimeAsNormal final : public AttributePass
{
public:
  Result<PointSources> apply(PointSources sources, const PassResources&) const override
  {
    const std::size_t time = *sources.front()->description().schema.find("gps_time");
    const ValueSource values = [time](const SourceChunk&, const PointBatch& batch,
                                 std::byte* to) -> Result<void>
    {
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        double value = 0.0;
        std::memcpy(&value, batch.columns[time].data() + i * sizeof value, sizeof value);
        const PackedNormal normal = normalOf(value);
        std::memcpy(to + i * sizeof normal, &normal, sizeof normal);
      }
      return {};
    };
    return withAttributes(std::move(sources), { normalAttribute() }, values);
  }
  std::vector<std::string> findings() const override { return { "The test found this." }; }
};

/// A survey of so many points as a LAS file, with one more attribute if it has a name.
std::string surveyFile(std::uint64_t points, const std::string& further = "")
{
  const std::string las = outputFolder() + "/survey" + further + ".las";
  const TerrainSource source(std::max<std::uint64_t>(points, 1), 7);
  LASWriter writer(las);
  SinkDescription description;
  description.schema = source.description().schema;
  if (!further.empty())
  {
    description.schema.add({ further, ScalarType::Float32, 1 });
  }
  description.grid = *source.description().grid;
  EXPECT_TRUE(writer.begin(description));
  PointBatch batch;
  for (std::uint64_t chunk = 0; points > 0 && chunk < source.chunkCount(); ++chunk)
  {
    EXPECT_TRUE(source.read(chunk, batch));
    if (!further.empty())
    {
      batch.columns.emplace_back(batch.size() * sizeof(float));
    }
    EXPECT_TRUE(writer.append(batch));
  }
  EXPECT_TRUE(writer.finish());
  return las;
}

LASIndexOptions withNormals(unsigned threads = 2)
{
  LASIndexOptions options;
  options.leafPoints = 1000;
  options.threads = threads;
  options.overwrite = true;
  options.normals = std::make_shared<const TimeAsNormal>();
  options.normalsOrigin = "of the test";
  return options;
}

TEST(IndexedNormals, AreThoseOfEachPointInEachNode)
{
  const std::string las = surveyFile(50000);
  const std::string side = las + lasIndexSuffix;
  const auto report = indexLASFile(las, side, withNormals());
  ASSERT_TRUE(report) << report.error().what;
  ASSERT_FALSE(report->warnings.empty());
  EXPECT_EQ(report->warnings.back(), "The test found this.");
  const auto indexed = IndexedLASFile::open(side);
  ASSERT_TRUE(indexed) << indexed.error().what;
  const StoredCloud& cloud = **indexed;
  const AttributeSchema& schema = cloud.description().schema;
  const auto normal = static_cast<std::uint32_t>(*schema.find("normal"));
  const auto time = static_cast<std::uint32_t>(*schema.find("gps_time"));
  EXPECT_EQ(normal, schema.size() - 1);
  EXPECT_FALSE(cloud.description().isComputed(normal));
  EXPECT_NE(schema[normal].description.find("of the test"), std::string::npos);
  std::uint64_t seen = 0;
  for (NodeIndex i = 0; i < cloud.hierarchy()->nodeCount(); ++i)
  {
    const auto node = cloud.read(i, { time, normal });
    ASSERT_TRUE(node) << node.error().what;
    const auto points = static_cast<std::uint32_t>(node->size());
    EXPECT_EQ(node->bytes(), cloud.decodedBytes(i, points, { time, normal }));
    const bool more = cloud.storedBytes(i, { normal }) > cloud.storedBytes(i, { time });
    EXPECT_TRUE(more || points == 0);
    EXPECT_EQ(cloud.read(i, { normal })->columns[0], node->columns[1]);
    for (std::size_t p = 0; p < points; ++p, ++seen)
    {
      double value = 0.0;
      std::memcpy(&value, node->columns[0].data() + p * sizeof value, sizeof value);
      PackedNormal found;
      std::memcpy(&found, node->columns[1].data() + p * sizeof found, sizeof found);
      ASSERT_EQ(found, normalOf(value)) << "node " << i << ", point " << p;
    }
  }
  EXPECT_EQ(seen, 50000u);
  const auto verified = cloud.verify();
  ASSERT_TRUE(verified);
  EXPECT_TRUE(verified->ok) << verified->firstError;
}

TEST(IndexedNormals, TheSameBytesForAnyThreadsAndMemory)
{
  const std::string las = surveyFile(50000);
  const std::string side = las + lasIndexSuffix;
  ASSERT_TRUE(indexLASFile(las, side, withNormals(1)));
  FileBytes first(side);
  for (const unsigned threads : { 2u, 7u })
  {
    LASIndexOptions options = withNormals(threads);
    options.memoryBytes = std::uint64_t(1) << 20;
    ASSERT_TRUE(indexLASFile(las, side, options));
    FileBytes other(side);
    ASSERT_EQ(other.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      ASSERT_EQ(other[i], first[i]) << threads << " threads, byte " << i;
    }
  }
}

TEST(IndexedNormals, OfNoPoints)
{
  const std::string las = surveyFile(0);
  const auto report = indexLASFile(las, las + lasIndexSuffix, withNormals());
  ASSERT_TRUE(report) << report.error().what;
  const auto indexed = IndexedLASFile::open(las + lasIndexSuffix);
  ASSERT_TRUE(indexed) << indexed.error().what;
  EXPECT_TRUE((*indexed)->description().schema.find("normal"));
  const auto verified = (*indexed)->verify();
  EXPECT_TRUE(verified && verified->ok) << verified->firstError;
}

TEST(IndexedNormals, AFileWithNormalsKeepsItsOwn)
{
  const std::string las = surveyFile(100, "normal");
  const auto refused = indexLASFile(las, las + lasIndexSuffix, withNormals());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::BadArgument);
  EXPECT_NE(refused.error().what.find("of its own"), std::string::npos);
  EXPECT_FALSE(fs::exists(las + lasIndexSuffix));
}

TEST(IndexedNormals, CancelledWhileTheyAreComputedLeavesNothing)
{
  const std::string las = surveyFile(50000);
  const std::string side = outputFolder() + "/cancelled.pfindex";
  const auto cancelled = indexLASFile(las, side, withNormals(),
    [](const Progress& progress) { return std::string(progress.phase) != "normals"; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, Error::Kind::Cancelled);
  EXPECT_FALSE(fs::exists(side));
  EXPECT_TRUE(filesInTheMaking(side).empty());
}

TEST(IndexedNormals, ProgressOfBothPartsIsOneFraction)
{
  const std::string las = surveyFile(200000);
  double last = 0.0;
  LASIndexOptions options = withNormals(1);
  const auto report = indexLASFile(las, las + lasIndexSuffix, options,
    [&last](const Progress& progress)
    {
      EXPECT_GE(progress.fraction, last - 1e-9);
      EXPECT_LE(progress.fraction, 1.0 + 1e-9);
      last = progress.fraction;
      return true;
    });
  EXPECT_TRUE(report);
}

TEST(IndexedNormals, VerifyFindsDamage)
{
  const std::string las = surveyFile(20000);
  const std::string side = las + lasIndexSuffix;
  ASSERT_TRUE(indexLASFile(las, side, withNormals()));
  const auto sound = SideFile::open(side);
  ASSERT_TRUE(sound);
  const ValueBlock block = (*sound)->content().table.blocks[2];
  FileBytes bytes(side);
  bytes[block.offset] ^= 1;
  bytes.write(fs::path(side).filename().string());
  const auto indexed = IndexedLASFile::open(side);
  ASSERT_TRUE(indexed) << indexed.error().what;
  const auto verified = (*indexed)->verify();
  ASSERT_TRUE(verified);
  EXPECT_FALSE(verified->ok);
  EXPECT_NE(verified->firstError.find("node 2"), std::string::npos) << verified->firstError;
  EXPECT_NE(verified->firstError.find("normal"), std::string::npos) << verified->firstError;
  // Positions and other attributes are not touched by it.
  const AttributeSchema& schema = (*indexed)->description().schema;
  EXPECT_TRUE((*indexed)->read(2, { 0 }));
  EXPECT_FALSE((*indexed)->read(2, { 0, static_cast<std::uint32_t>(schema.size() - 1) }));
}
} // namespace
} // namespace pointfront::test
