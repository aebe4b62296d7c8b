#include "ImageValuesPass.h"
#include "RasterImages.h"

#include "CloudInMemory.h"
#include "LASFormat.h"
#include "ProjCoordinateSystems.h"
#include "WrittenTiff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace pointfront;
using pointfront::test::CloudInMemory;
using pointfront::test::WrittenTiff;

namespace
{
const std::string ortho = POINTFRONT_SHARED_DATA "/ortho/";

/// A cloud with attributes and offsets of another one's points.
class Shifted final : public PointSource
{
public:
  Shifted(std::unique_ptr<PointSource> original, glm::dvec3 by)
    : original_(std::move(original))
    , by_(by)
  {
  }
  const SourceDescription& description() const override { return original_->description(); }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t c) const override { return original_->chunkPoints(c); }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    Result<void> done = original_->read(chunk, batch);
    const std::size_t column = *description().schema.find("rgb");
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      batch.positions[i] += by_;
      const std::uint16_t old[3] = { 1, 2, 3 };
      std::memcpy(batch.columns[column].data() + 6 * i, old, sizeof old);
    }
    return done;
  }

private:
  std::unique_ptr<PointSource> original_;
  glm::dvec3 by_;
};

std::unique_ptr<PointSource> opened(const std::string& path)
{
  auto source = LASFormat().open(path);
  EXPECT_TRUE(source.ok()) << (source ? "" : source.error().what);
  return source ? std::move(*source) : nullptr;
}

std::unique_ptr<PointSource> cloud(std::vector<glm::dvec3> points, const std::string& wkt = "")
{
  return std::make_unique<CloudInMemory>("cloud", std::move(points), wkt);
}

struct Outcome
{
  PointBatch points;
  AttributeSchema schema;
  std::string error;
  std::string findings;

  std::vector<double> values(const std::string& name) const
  {
    std::vector<double> all;
    const auto column = schema.find(name);
    EXPECT_TRUE(column) << name;
    const std::size_t bytes = sizeOf(schema[*column].type);
    for (std::size_t at = 0; at < points.columns[*column].size(); at += bytes)
    {
      const std::byte* p = points.columns[*column].data() + at;
      all.push_back(valueAt(schema[*column].type, p));
    }
    return all;
  }

private:
  static double valueAt(ScalarType type, const std::byte* p)
  {
    return visitScalar(type,
      [p](auto value)
      {
        std::memcpy(&value, p, sizeof value);
        return static_cast<double>(value);
      });
  }
};

Outcome coloured(std::unique_ptr<PointSource> source, std::vector<RasterInput> inputs)
{
  Outcome outcome;
  PointSources sources;
  sources.push_back(std::move(source));
  const ImageValuesPass pass(std::move(inputs), std::make_shared<ProjCoordinateSystems>());
  PassResources resources;
  resources.memoryBytes = 1; // the least cache that there is
  Result<PointSources> result = pass.apply(std::move(sources), resources);
  if (!result)
  {
    outcome.error = result.error().what;
    return outcome;
  }
  const PointSource& ready = *result->front();
  outcome.schema = ready.description().schema;
  for (std::uint64_t chunk = 0; chunk < ready.chunkCount(); ++chunk)
  {
    PointBatch batch;
    const Result<void> done = ready.read(chunk, batch);
    outcome.error += done ? "" : done.error().what;
    EXPECT_TRUE(ready.read(chunk, batch).ok() || !done); // twice: counted once
    auto& all = outcome.points;
    all.positions.insert(all.positions.end(), batch.positions.begin(), batch.positions.end());
    all.columns.resize(batch.columns.size());
    for (std::size_t c = 0; c < batch.columns.size(); ++c)
    {
      all.columns[c].insert(all.columns[c].end(), batch.columns[c].begin(), batch.columns[c].end());
    }
  }
  for (const std::string& finding : pass.findings())
  {
    outcome.findings += finding + "\n";
  }
  return outcome;
}

struct Expected
{
  bool inside = false;
  double colour[3] = {};
};

std::vector<Expected> expectedColours()
{
  std::ifstream file(ortho + "autzen/expected_nearest_rgb.csv");
  std::vector<Expected> rows;
  std::string line;
  std::getline(file, line); // index,col,row,inside,edge,r,g,b
  while (std::getline(file, line))
  {
    for (char& c : line)
    {
      c = c == ',' ? ' ' : c;
    }
    std::istringstream fields(line);
    double n[5] = {};
    Expected row;
    fields >> n[0] >> n[1] >> n[2] >> n[3] >> n[4] >> row.colour[0] >> row.colour[1] >>
      row.colour[2];
    row.inside = n[3] != 0.0;
    rows.push_back(row);
  }
  return rows;
}
} // namespace

TEST(ImageValuesPass, AutzenAsPublished)
{
  const Outcome outcome = coloured(opened(ortho + "autzen/autzen-point-format-3.las"),
    { { "rgb", { ortho + "autzen/autzen.jpg" } } });
  ASSERT_EQ(outcome.error, "");
  const std::vector<double> rgb = outcome.values("rgb");
  ASSERT_EQ(rgb.size(), 3u * 106u);
  EXPECT_EQ(rgb[0], 210);
  EXPECT_EQ(rgb[1], 205);
  EXPECT_EQ(rgb[2], 185);
  const std::vector<Expected> expected = expectedColours();
  ASSERT_EQ(expected.size(), 106u);
  double sum[3] = {};
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      EXPECT_EQ(rgb[3 * i + c], expected[i].inside ? expected[i].colour[c] : 0.0) << i;
      sum[c] += rgb[3 * i + c];
    }
  }
  EXPECT_EQ(sum[0], 12584);
  EXPECT_EQ(sum[1], 13057);
  EXPECT_EQ(sum[2], 11543);
  EXPECT_NE(outcome.findings.find("1 of 106 points lie where no image"), std::string::npos)
    << outcome.findings;
}

TEST(ImageValuesPass, PointsOutsideKeepTheirColour)
{
  auto moved = std::make_unique<Shifted>(
    opened(ortho + "autzen/autzen-point-format-3.las"), glm::dvec3(1600, 2200, 60));
  const Outcome outcome =
    coloured(std::move(moved), { { "rgb", { ortho + "autzen/autzen.jpg" } } });
  ASSERT_EQ(outcome.error, "");
  const std::vector<double> rgb = outcome.values("rgb");
  ASSERT_EQ(rgb.size(), 3u * 106u);
  int inside = 0;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
  {
    inside += rgb[i] == 1 && rgb[i + 1] == 2 && rgb[i + 2] == 3 ? 0 : 1;
  }
  EXPECT_EQ(inside, 23);
}

TEST(ImageValuesPass, AMosaicIsTheImageItWasCutFrom)
{
  std::vector<glm::dvec3> points;
  const ProjCoordinateSystems systems;
  const auto whole =
    RasterFile::open(ortho + "mosaic_2x2/RGB.byte.tif", RasterUse::Colour, systems);
  ASSERT_TRUE(whole.ok()) << whole.error().what;
  for (int row = 0; row < 718; ++row)
  {
    for (int column = 0; column < 791; ++column)
    {
      const glm::dvec2 p = whole->transform.toGround({ column + 0.5, row + 0.5 });
      points.push_back({ p.x, p.y, 0.0 });
    }
  }
  const std::string folder = ortho + "mosaic_2x2/";
  const Outcome one = coloured(cloud(points), { { "rgb", { folder + "RGB.byte.tif" } } });
  const Outcome four = coloured(cloud(points),
    { { "rgb",
      { folder + "rgb1.tif", folder + "rgb2.tif", folder + "rgb3.tif", folder + "rgb4.tif" } } });
  const Outcome tiled =
    coloured(cloud(points), { { "rgb", { ortho + "geotiff_kinds/rgb_lzw.tif" } } });
  const Outcome planar =
    coloured(cloud(points), { { "rgb", { ortho + "geotiff_kinds/rgb_deflate.tif" } } });
  ASSERT_EQ(one.error + four.error + tiled.error + planar.error, "");
  EXPECT_EQ(one.points.columns, four.points.columns);
  EXPECT_EQ(one.points.columns, tiled.points.columns);
  EXPECT_EQ(one.points.columns, planar.points.columns);
  const std::vector<double> rgb = one.values("rgb");
  double sum = 0.0;
  for (const double value : rgb)
  {
    sum += value;
  }
  EXPECT_GT(sum, 1e7) << "a picture, not black";
}

TEST(ImageValuesPass, TheFirstImageNamedWinsWhereItHasData)
{
  WrittenTiff a;
  a.values = { 10, 11, 12, 13, 0, 15, 16, 17, 18, 19, 20, 21 };
  a.noData = "0";
  a.at(0, 3);
  WrittenTiff b;
  b.values = std::vector<double>(12, 99);
  b.at(0, 3);
  WrittenTiff c = b;
  c.at(2, 3); // reaches two pixels further
  c.values.assign(12, 50);
  const std::vector<RasterInput> ab{ { "v",
    { a.write("first.tif"), b.write("second.tif"), c.write("third.tif") } } };
  const std::vector<glm::dvec3> points{ { 0.5, 2.5, 0 }, { 0.5, 1.5, 0 }, { 3.5, 0.5, 0 },
    { 5.5, 0.5, 0 }, { 6.5, 0.5, 0 }, { NAN, 0.5, 0 } };
  const Outcome outcome = coloured(cloud(points), ab);
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.values("v"), (std::vector<double>{ 10, 99, 21, 50, 0, 0 }));
  EXPECT_NE(outcome.findings.find("2 of 6 points"), std::string::npos) << outcome.findings;
}

TEST(ImageValuesPass, APointOnAnEdgeBelongsToThePixelRightAndBelow)
{
  WrittenTiff image;
  image.values = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
  image.at(0, 3);
  const Outcome outcome = coloured(cloud({ { 1, 2.5, 0 }, { 0.999999, 2.5, 0 }, { 1, 2, 0 },
                                     { 0, 3, 0 }, { 4, 1, 0 }, { 1, 0, 0 } }),
    { { "v", { image.write("edges.tif") } } });
  EXPECT_EQ(outcome.values("v"), (std::vector<double>{ 1, 0, 5, 0, 0, 0 }));
  EXPECT_NE(outcome.findings.find("2 of 6"), std::string::npos) << "the far edges are outside";
}

TEST(ImageValuesPass, ATransparentPixelSaysNothing)
{
  WrittenTiff image;
  image.width = 2;
  image.height = 1;
  image.channels = 4;
  image.alpha = true;
  image.values = { 200, 100, 50, 128, 1, 2, 3, 0 };
  image.at(0, 1);
  const Outcome outcome = coloured(
    cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }), { { "rgb", { image.write("alpha.tif") } } });
  EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ 200, 100, 50, 0, 0, 0 }))
    << "not multiplied by alpha";
}

TEST(ImageValuesPass, EveryTypeOfPixelIsExact)
{
  struct Case
  {
    int bits;
    int format;
    std::vector<double> values;
  };
  const Case cases[] = { { 8, 1, { 0, 255 } }, { 16, 1, { 1, 65535 } },
    { 32, 1, { 16777217, 4294967295.0 } }, { 8, 2, { -128, 127 } }, { 16, 2, { -32768, 32767 } },
    { 32, 2, { -2147483648.0, 123456789 } }, { 32, 3, { -1.5, 3e10f } },
    { 64, 3, { 1.23456789012, 1e300 } } };
  for (const Case& c : cases)
  {
    for (const int tile : { 0, 16 })
    {
      WrittenTiff image;
      image.width = 2;
      image.height = 1;
      image.bits = c.bits;
      image.sampleFormat = c.format;
      image.values = c.values;
      image.tile = tile;
      const std::string name = "type" + std::to_string(c.format * 100 + c.bits + tile) + ".tif";
      image.at(0, 1);
      const Outcome outcome =
        coloured(cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }), { { "v", { image.write(name) } } });
      ASSERT_EQ(outcome.error, "");
      EXPECT_EQ(outcome.values("v"), c.values) << c.bits << " bits, format " << c.format;
    }
  }
}

TEST(ImageValuesPass, APaletteIsColourOrIndex)
{
  for (const int tile : { 0, 16 })
  {
    WrittenTiff image;
    image.width = 2;
    image.height = 1;
    image.values = { 3, 200 };
    image.palette = true;
    image.tile = tile;
    image.at(0, 1);
    const std::string path = image.write("palette" + std::to_string(tile) + ".tif");
    const Outcome outcome = coloured(cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }),
      { { "class_map", { path } }, { "rgb", { path } } });
    ASSERT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.values("class_map"), (std::vector<double>{ 3, 200 }));
    EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ 252, 3, 7, 55, 200, 7 }));
  }
}

TEST(ImageValuesPass, GreyAndSixteenBitsBecomeColours)
{
  WrittenTiff grey;
  grey.width = 1;
  grey.height = 1;
  grey.values = { 90 };
  grey.at(0, 1);
  WrittenTiff deep = grey;
  deep.channels = 3;
  deep.bits = 16;
  deep.values = { 65535, 514, 0 };
  deep.at(1, 1);
  const Outcome one =
    coloured(cloud({ { 0.5, 0.5, 0 } }), { { "rgb", { grey.write("grey.tif") } } });
  EXPECT_EQ(one.values("rgb"), (std::vector<double>{ 90, 90, 90 }));
  EXPECT_EQ(one.schema[0].type, ScalarType::UInt8);
  const Outcome both = coloured(cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }),
    { { "rgb", { grey.write("grey.tif"), deep.write("deep.tif") } } });
  EXPECT_EQ(both.values("rgb"), (std::vector<double>{ 23130, 23130, 23130, 65535, 514, 0 }));
}

TEST(ImageValuesPass, AColumnThatIsThereKeepsItsType)
{
  WrittenTiff image;
  image.width = 1;
  image.height = 1;
  image.bits = 16;
  image.sampleFormat = 2;
  image.values = { 6 };
  image.at(636000, 850000, 1000);
  WrittenTiff tooLarge = image;
  tooLarge.values = { 700 };
  tooLarge.at(637000, 850000, 1000);
  const Outcome outcome = coloured(opened(ortho + "autzen/autzen-point-format-3.las"),
    { { "classification", { image.write("six.tif"), tooLarge.write("large.tif") } } });
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.schema[*outcome.schema.find("classification")].type, ScalarType::UInt8);
  const std::vector<double> classes = outcome.values("classification");
  int six = 0;
  for (std::size_t i = 0; i < classes.size(); ++i)
  {
    const glm::dvec3& p = outcome.points.positions[i];
    const bool inSix = p.x >= 636000 && p.x < 637000 && p.y > 849000 && p.y <= 850000;
    six += inSix ? 1 : 0;
    EXPECT_EQ(classes[i] == 6, inSix) << i;
  }
  EXPECT_GT(six, 5);
  EXPECT_NE(outcome.findings.find("cannot hold"), std::string::npos) << outcome.findings;
}

TEST(ImageValuesPass, ImagesOfAnotherSystemAreLookedUpThroughIt)
{
  const ProjCoordinateSystems systems;
  WrittenTiff image; // WGS 84 / UTM zone 32N, 9 degrees east
  image.width = 2;
  image.height = 1;
  image.values = { 7, 8 };
  image.at(499000, 5001000, 1000);
  image.scale[1] = 30000;
  image.keys = { 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32632 };
  const std::string path = image.write("utm.tif");
  const std::vector<glm::dvec3> degrees{ { 8.999, 45, 5 }, { 9.001, 45, 5 }, { 9.1, 45, 5 } };
  const Outcome outcome =
    coloured(cloud(degrees, systems.parse("EPSG:4326")->wkt), { { "zone", { path } } });
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.values("zone"), (std::vector<double>{ 7, 8, 0 }));
  EXPECT_EQ(outcome.points.positions[0], degrees[0]) << "points stay where they are";
  const Outcome silent = coloured(cloud({ { 499500, 5000000, 0 } }), { { "zone", { path } } });
  EXPECT_EQ(silent.values("zone"), std::vector<double>{ 7 });
  EXPECT_NE(silent.findings.find("taken to be in that of the images"), std::string::npos);
}

TEST(ImageValuesPass, TilesAreTouchedOnceAndTheCacheStaysSmall)
{
  // 42.7 MB of pixels, a cache of 10 MiB; the points of a chunk jump all over the image.
  constexpr std::uint64_t cacheBytes = 10u << 20;
  const ProjCoordinateSystems systems;
  RasterTiles tiles(cacheBytes);
  const auto mosaic =
    RasterMosaic::open({ ortho + "autzen/autzen.jpg" }, RasterUse::Colour, systems, tiles);
  ASSERT_TRUE(mosaic.ok()) << mosaic.error().what;
  const RasterFile& file = mosaic.value().files()[0];
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 60000; ++i)
  {
    const double x = std::fmod(i * 1237.5, 3248.0);
    const double y = std::fmod(i * 2741.25, 4385.0);
    const glm::dvec2 p = file.transform.toGround({ x, y });
    points.push_back({ p.x, p.y, 0.0 });
  }
  std::uint64_t largest = 0;
  const auto visit = [&](std::size_t, const RasterFile&, const std::byte*)
  {
    largest = std::max(largest, tiles.bytesUsed());
    return true;
  };
  const auto without = mosaic.value().sample(points, { nullptr }, visit);
  ASSERT_TRUE(without.ok()) << without.error().what;
  EXPECT_LT(*without, 10u);
  const RasterTiles::Layout& layout = tiles.layout(0);
  const std::uint64_t all = static_cast<std::uint64_t>(layout.across) *
    static_cast<std::uint64_t>((4385 + layout.height - 1) / layout.height);
  EXPECT_GE(tiles.tilesRead(), all - all / 10);
  EXPECT_LE(tiles.tilesRead(), all + all / 10) << "each once, give or take what the cache drops";
  EXPECT_LE(largest, cacheBytes + (4u << 20)) << "a band of tiles is read at a time";
}

TEST(ImageValuesPass, AnImageThatIsCutShortIsAnErrorThatNamesIt)
{
  for (const char* file : { "geotiff_kinds/cog_rgba.tif", "autzen/autzen.jpg" })
  {
    std::ifstream in(ortho + file, std::ios::binary);
    std::string bytes{ std::istreambuf_iterator<char>(in), {} };
    bytes.resize(bytes.size() / 2);
    const std::string name = std::string("cut_short") + (file + std::strlen(file) - 4);
    const std::string cut = testing::TempDir() + name;
    std::ofstream(cut, std::ios::binary) << bytes;
    std::ofstream(testing::TempDir() + "cut_short.wld") << "1\n0\n0\n-1\n0.5\n4384.5\n";
    const Outcome outcome = coloured(cloud({ { 1, 1, 0 } }), { { "rgb", { cut } } });
    EXPECT_NE(outcome.error.find(name), std::string::npos) << outcome.error;
  }
}

TEST(ImageValuesPass, ImagesOfOneAttributeHaveOneType)
{
  WrittenTiff a;
  a.values.assign(12, 1);
  a.at(0, 3);
  WrittenTiff b = a;
  b.bits = 16;
  const Outcome outcome =
    coloured(cloud({ { 1, 1, 0 } }), { { "v", { a.write("u8.tif"), b.write("u16.tif") } } });
  EXPECT_NE(outcome.error.find("u16.tif: has 1 x uint16"), std::string::npos) << outcome.error;
}

// EXPECTED: 10,028,461 points inside; a mean difference of 2.70 levels to the colours stored, 99.06
// % within 8. Half a pixel off would give 3.70.
TEST(LargeRaster, ColoursOfTenMillionPoints)
{
  std::unique_ptr<PointSource> source =
    opened(POINTFRONT_SHARED_DATA "/large/autzen_10653336_rgb_intensity.laz");
  ASSERT_TRUE(source);
  const ProjCoordinateSystems systems;
  RasterTiles tiles(10u << 20);
  const auto mosaic =
    RasterMosaic::open({ ortho + "autzen/autzen.jpg" }, RasterUse::Colour, systems, tiles);
  ASSERT_TRUE(mosaic.ok()) << mosaic.error().what;
  const std::size_t column = *source->description().schema.find("rgb");
  std::uint64_t inside = 0;
  std::uint64_t near = 0;
  double sum = 0.0;
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    PointBatch batch;
    ASSERT_TRUE(source->read(chunk, batch).ok());
    const auto visit = [&](std::size_t point, const RasterFile&, const std::byte* pixel)
    {
      std::uint16_t own[3];
      std::memcpy(own, batch.columns[column].data() + 6 * point, sizeof own);
      int largest = 0;
      for (std::size_t c = 0; c < 3; ++c)
      {
        largest = std::max(largest, std::abs(std::to_integer<int>(pixel[c]) - own[c]));
      }
      ++inside;
      near += largest <= 8 ? 1 : 0;
      sum += largest;
      return true;
    };
    const auto without = mosaic.value().sample(batch.positions, { nullptr }, visit);
    ASSERT_TRUE(without.ok()) << without.error().what;
  }
  EXPECT_EQ(inside, 10028461u);
  EXPECT_NEAR(sum / static_cast<double>(inside), 2.70, 0.005);
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(inside), 0.9906, 0.00005);
}
