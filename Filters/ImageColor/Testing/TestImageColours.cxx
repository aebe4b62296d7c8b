// Depths of colours: those of the points and those of the images in one column.

#include "CloudInMemory.h"
#include "ColouredCloud.h"
#include "WrittenTiff.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{
/// Grey points of 16 bits, 10 a chunk, one at x = 0.5, 1.5 ... each.
class GreyPoints final : public PointSource
{
public:
  using Reads = std::shared_ptr<std::atomic<std::size_t>>;
  explicit GreyPoints(std::vector<std::uint16_t> greys, Reads reads = nullptr)
    : greys_(std::move(greys))
    , places_("grey", placesOf(greys_.size()), "", 10)
    , reads_(std::move(reads))
  {
    description_ = places_.description();
    description_.schema.add({ "rgb", ScalarType::UInt16, 3 });
  }
  SourceDescription& describe() { return description_; }

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return places_.chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return places_.chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    reads_ ? void(++*reads_) : void();
    Result<void> done = places_.read(chunk, batch);
    batch.columns.assign(1, {});
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const std::uint16_t grey = greys_[10 * chunk + i];
      const std::uint16_t rgb[3] = { grey, grey, grey };
      const auto* const bytes = reinterpret_cast<const std::byte*>(rgb);
      batch.columns[0].insert(batch.columns[0].end(), bytes, bytes + sizeof rgb);
    }
    return done;
  }

private:
  static std::vector<glm::dvec3> placesOf(std::size_t count)
  {
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < count; ++i)
    {
      places.emplace_back(static_cast<double>(i) + 0.5, 0.5, 0.0);
    }
    return places;
  }
  std::vector<std::uint16_t> greys_;
  CloudInMemory places_;
  SourceDescription description_;
  Reads reads_; ///< chunks that have been read; may be null
};

/// One pixel at x = 0 to 1.
std::string onePixel(const std::string& name, int bits, double value)
{
  WrittenTiff tiff;
  tiff.width = 1;
  tiff.height = 1;
  tiff.channels = 3;
  tiff.bits = bits;
  tiff.values = { value, value, value };
  return tiff.at(0, 1).write(name);
}

double red(const ColouredCloud& cloud, std::size_t point)
{
  return cloud.values("rgb").at(3 * point);
}
} // namespace

TEST(ImageColours, OnePointOfSixteenBitsMakesItsFileOneOfSixteen)
{
  for (const std::size_t bright : { 5u, 183u, 399u })
  {
    std::vector<std::uint16_t> greys(400, 0);
    greys[bright] = 50000;
    const ColouredCloud outcome = coloured(std::make_unique<GreyPoints>(std::move(greys)),
      { { "rgb", { onePixel("200.tif", 8, 200) } } });
    ASSERT_EQ(outcome.error, "");
    EXPECT_EQ(red(outcome, 0), 200 * 257) << bright;
    EXPECT_EQ(red(outcome, bright), 50000);
  }
}

TEST(ImageColours, PointsOfEightBitsStaySoBesideImagesOfEight)
{
  const ColouredCloud outcome =
    coloured(std::make_unique<GreyPoints>(std::vector<std::uint16_t>(400, 100)),
      { { "rgb", { onePixel("200.tif", 8, 200) } } });
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(red(outcome, 0), 200);
  EXPECT_EQ(red(outcome, 1), 100);
}

TEST(ImageColours, PointsOfEightBitsAreWidenedBesideImagesOfSixteen)
{
  const std::string wide = onePixel("40000.tif", 16, 40000);
  const ColouredCloud outcome = coloured(
    std::make_unique<GreyPoints>(std::vector<std::uint16_t>(400, 100)), { { "rgb", { wide } } });
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(red(outcome, 0), 40000);
  EXPECT_EQ(red(outcome, 1), 25700);
  EXPECT_EQ(outcome.colourImage, wide);
  // They are not where the points have 16 bits themselves.
  std::vector<std::uint16_t> greys(400, 100);
  greys[250] = 256;
  const ColouredCloud deep =
    coloured(std::make_unique<GreyPoints>(std::move(greys)), { { "rgb", { wide } } });
  ASSERT_EQ(deep.error, "");
  EXPECT_EQ(red(deep, 0), 40000);
  EXPECT_EQ(red(deep, 1), 100);
  EXPECT_EQ(deep.colourImage, "");
}

TEST(ImageColours, AKnownDepthIsNotLookedFor)
{
  const std::string narrow = onePixel("200.tif", 8, 200);
  const auto readsWith = [&](std::optional<std::uint16_t> known, double expected)
  {
    const auto reads = std::make_shared<std::atomic<std::size_t>>(0);
    auto points = std::make_unique<GreyPoints>(std::vector<std::uint16_t>(400, 100), reads);
    points->describe().largestColour = known;
    const ColouredCloud outcome = coloured(std::move(points), { { "rgb", { narrow } } });
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(red(outcome, 0), expected);
    return reads->load();
  };
  const std::size_t looked = readsWith(std::nullopt, 200);
  EXPECT_GE(looked, readsWith(255, 200) + 40);
  EXPECT_GE(looked, readsWith(256, 51400) + 40);
}
