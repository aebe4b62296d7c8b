#include "OraclePicture.h"
#include "TruthCase.h"
#include "TruthFiles.h"
#include "TruthScore.h"

#include "PLYFormat.h"
#include "PNGReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace pointfront::truth
{
namespace
{
constexpr float nothing = std::numeric_limits<float>::infinity();

/// The knot from afar and points of it.
class KnotScore : public testing::Test
{
protected:
  TruthScore score(const Picture& drawn, const std::vector<float>& depth) const
  {
    const auto result = scoreAgainst(truth_, case_.pixels(), case_.grade(), drawn, depth);
    EXPECT_TRUE(result) << result.error().what;
    return result ? *result : TruthScore{};
  }
  std::size_t count(int atLeast, int atMost) const
  {
    return std::size_t(std::count_if(truth_.coverage.begin(), truth_.coverage.end(),
      [&](int c) { return c >= atLeast && c <= atMost; }));
  }

  const TruthCase case_{ makeKnot(), { "far", 2.0, 160, 120 } };
  const TruthPicture truth_ = case_.draw(4);
};

TEST_F(KnotScore, TheTruthItselfIsRight)
{
  const TruthScore result = score(truth_.colours, truth_.depth);
  EXPECT_TRUE(std::isinf(result.psnr));
  EXPECT_EQ(result.ssim, 1.0);
  EXPECT_EQ(result.holes, 0.0);
  EXPECT_EQ(result.innerBloat, 0.0);
  EXPECT_EQ(result.bloat, 0.0);
  EXPECT_EQ(result.depthError, 0.0);
}

TEST_F(KnotScore, EachFaultIsCountedWhereItIs)
{
  const std::vector<float> empty(truth_.depth.size(), nothing);
  EXPECT_EQ(score(truth_.colours, empty).holes, 100.0);
  EXPECT_EQ(score(truth_.colours, empty).bloat, 0.0);

  const std::vector<float> onTheEye(truth_.depth.size(), 0.01f);
  const TruthScore covered = score(truth_.colours, onTheEye);
  EXPECT_EQ(covered.innerBloat, 100.0);
  EXPECT_EQ(covered.holes, 0.0);
  EXPECT_NEAR(covered.bloat, 100.0 * double(count(0, 0)) / double(count(128, 255)), 1e-9);

  // One spacing behind is an error of the depth, two and a half are a hole where the surface
  // faces the eye; at its edges, where a pixel spans more depth, they are not yet one.
  std::vector<float> behind = truth_.depth;
  for (float& depth : behind)
  {
    depth += float(case_.grade().spacing);
  }
  const TruthScore off = score(truth_.colours, behind);
  EXPECT_EQ(off.holes, 0.0);
  EXPECT_NEAR(off.depthError, 1.0, 1e-4);
  for (float& depth : behind)
  {
    depth += 1.5f * float(case_.grade().spacing);
  }
  EXPECT_GT(score(truth_.colours, behind).holes, 10.0);
  EXPECT_LT(score(truth_.colours, behind).holes, 90.0);
}

TEST_F(KnotScore, TheOracleIsCloserTheMorePointsThereAre)
{
  double before = 0.0;
  for (double spacingPx : { 8.0, 2.0, 0.7 })
  {
    SpacingGrade grade = case_.grade();
    grade.spacing *= 0.5 * spacingPx;
    const TruthPoints points = sampleBlueNoise({ case_.rays(), case_.pixels(), grade }, 3);
    const TruthScore result =
      score(drawOracle(truth_, case_.pixels(), grade, points), truth_.depth);
    EXPECT_GT(result.psnr, before + 1.0) << spacingPx;
    EXPECT_EQ(result.holes, 0.0);
    before = result.psnr;
  }
  EXPECT_GT(before, 26.0); // one ray a pixel: the edges of its stripes alias
}

TEST_F(KnotScore, FilesHoldWhatTheyWereGiven)
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "KnotScore.Files";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const TruthPoints points = case_.blueNoise(3);
  ASSERT_TRUE(writePoints((folder / "points.ply").string(), points));
  ASSERT_TRUE(writePicture((folder / "truth.png").string(), truth_.colours));
  ASSERT_TRUE(writeDepth((folder / "depth.f32").string(), truth_.depth));

  const auto source = PLYFormat({ 1, {} }).open((folder / "points.ply").string());
  ASSERT_TRUE(source) << source.error().what;
  PointBatch batch;
  ASSERT_TRUE((*source)->read(0, batch));
  ASSERT_EQ(batch.size(), points.size());
  EXPECT_EQ(batch.positions, points.positions);
  const AttributeSchema& schema = (*source)->description().schema;
  const std::byte* rgb = batch.columns[*schema.find("rgb")].data();
  EXPECT_EQ(std::memcmp(rgb, points.colours.data(), 3 * points.size()), 0);
  const std::byte* normals = batch.columns[*schema.find("normal")].data();
  EXPECT_EQ(std::memcmp(normals, points.normals.data(), 12 * points.size()), 0);

  const Result<Picture> picture = readPNG((folder / "truth.png").string());
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->rgba, truth_.colours.rgba);
  std::vector<float> depth(truth_.depth.size());
  std::ifstream((folder / "depth.f32").string(), std::ios::binary)
    .read(reinterpret_cast<char*>(depth.data()), std::streamsize(4 * depth.size()));
  EXPECT_EQ(depth, truth_.depth);
}
} // namespace
} // namespace pointfront::truth
