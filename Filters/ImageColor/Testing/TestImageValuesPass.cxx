#include "ColouredCloud.h"
#include "ImageValuesPass.h"
#include "RasterImages.h"

#include "OrthoImages.h"
#include "ProjCoordinateSystems.h"
#include "WrittenTiff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

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
  const ColouredCloud outcome = coloured(opened(ortho + "autzen/autzen-point-format-3.las"),
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
  const ColouredCloud outcome =
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
  const ColouredCloud one = coloured(cloud(points), { { "rgb", { folder + "RGB.byte.tif" } } });
  const ColouredCloud four = coloured(cloud(points),
    { { "rgb",
      { folder + "rgb1.tif", folder + "rgb2.tif", folder + "rgb3.tif", folder + "rgb4.tif" } } });
  const ColouredCloud tiled =
    coloured(cloud(points), { { "rgb", { ortho + "geotiff_kinds/rgb_lzw.tif" } } });
  const ColouredCloud planar =
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
  const ColouredCloud outcome = coloured(cloud(points), ab);
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.values("v"), (std::vector<double>{ 10, 99, 21, 50, 0, 0 }));
  EXPECT_NE(outcome.findings.find("2 of 6 points"), std::string::npos) << outcome.findings;
}

TEST(ImageValuesPass, APointOnAnEdgeBelongsToThePixelRightAndBelow)
{
  WrittenTiff image;
  image.values = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
  image.at(0, 3);
  const ColouredCloud outcome = coloured(cloud({ { 1, 2.5, 0 }, { 0.999999, 2.5, 0 }, { 1, 2, 0 },
                                           { 0, 3, 0 }, { 4, 1, 0 }, { 1, 0, 0 } }),
    { { "v", { image.write("edges.tif") } } });
  EXPECT_EQ(outcome.values("v"), (std::vector<double>{ 1, 0, 5, 0, 0, 0 }));
  EXPECT_NE(outcome.findings.find("2 of 6"), std::string::npos) << "the far edges are outside";
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
  const ColouredCloud outcome = coloured(opened(ortho + "autzen/autzen-point-format-3.las"),
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
  const ColouredCloud outcome =
    coloured(cloud(degrees, systems.parse("EPSG:4326")->wkt), { { "zone", { path } } });
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.values("zone"), (std::vector<double>{ 7, 8, 0 }));
  EXPECT_EQ(outcome.points.positions[0], degrees[0]) << "points stay where they are";
  const ColouredCloud silent =
    coloured(cloud({ { 499500, 5000000, 0 } }), { { "zone", { path } } });
  EXPECT_EQ(silent.values("zone"), std::vector<double>{ 7 });
  EXPECT_NE(silent.findings.find("taken to be in that of the images"), std::string::npos);
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
    const ColouredCloud outcome = coloured(cloud({ { 1, 1, 0 } }), { { "rgb", { cut } } });
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
  const ColouredCloud outcome =
    coloured(cloud({ { 1, 1, 0 } }), { { "v", { a.write("u8.tif"), b.write("u16.tif") } } });
  EXPECT_NE(outcome.error.find("u16.tif: has 1 x uint16"), std::string::npos) << outcome.error;
}
