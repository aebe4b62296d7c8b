#include "pointfront/Picture/PictureComparison.h"

#include "pointfront/Picture/StructuralSimilarity.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

namespace pointfront
{
namespace
{
using Colour = std::array<std::uint8_t, 3>;
constexpr int noticeable = 8;
constexpr int greyThousandths[3] = { 299, 587, 114 };
constexpr std::uint8_t half = 128;
constexpr std::uint8_t full = 255;

Error wrong(const std::string& what)
{
  return makeError(Error::Kind::BadArgument, what);
}

std::string sizeText(const Picture& picture)
{
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

bool isBackground(const std::uint8_t* rgba, const Colour& background)
{
  return rgba[3] == 0 || std::equal(background.begin(), background.end(), rgba);
}

/// How white each pixel of the mask is.
std::vector<std::uint8_t> coverageOf(const Picture& mask)
{
  std::vector<std::uint8_t> coverage(mask.pixels());
  for (std::size_t i = 0; i < coverage.size(); ++i)
  {
    const std::uint8_t* rgba = mask.rgba.data() + 4 * i;
    coverage[i] = rgba[3] == 0 ? std::uint8_t(0) : std::max({ rgba[0], rgba[1], rgba[2] });
  }
  return coverage;
}

std::vector<std::uint8_t> coverageOfDrawn(const Picture& reference, const Colour& background)
{
  std::vector<std::uint8_t> coverage(reference.pixels());
  for (std::size_t i = 0; i < coverage.size(); ++i)
  {
    coverage[i] = isBackground(reference.rgba.data() + 4 * i, background) ? std::uint8_t(0) : full;
  }
  return coverage;
}

Result<Colour> backgroundOutside(
  const Picture& reference, const std::vector<std::uint8_t>& coverage)
{
  std::unordered_map<std::uint32_t, std::uint64_t> counts;
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < coverage.size(); ++i)
  {
    const std::uint8_t* rgba = reference.rgba.data() + 4 * i;
    if (coverage[i] == 0 && rgba[3] != 0)
    {
      ++counts[rgba[0] | std::uint32_t(rgba[1]) << 8 | std::uint32_t(rgba[2]) << 16];
      ++outside;
    }
  }
  if (outside == 0)
  {
    return wrong("the mask leaves no pixel of the reference outside, so it does not show what the "
                 "background is: say its colour");
  }
  const auto most = std::max_element(
    counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (2 * most->second <= outside)
  {
    return wrong("the reference has no colour in half of the pixels outside of the mask, so it "
                 "does not show what the background is: say its colour");
  }
  const std::uint32_t rgb = most->first;
  return Colour{ std::uint8_t(rgb), std::uint8_t(rgb >> 8), std::uint8_t(rgb >> 16) };
}

Result<void> checkSizes(
  const Picture& drawn, const Picture& reference, const ComparisonOptions& options)
{
  const auto differs = [&reference](const Picture& other)
  { return other.width != reference.width || other.height != reference.height; };
  if (differs(drawn))
  {
    return wrong("the pictures have " + sizeText(drawn) + " and " + sizeText(reference) +
      " pixels: only pictures of one size can be compared");
  }
  if (options.mask != nullptr && differs(*options.mask))
  {
    return wrong("the mask has " + sizeText(*options.mask) + " pixels, the pictures " +
      sizeText(reference) + ": they must be of one size");
  }
  return {};
}

/// Colour errors of the pixels with at least that coverage; an empty `coverage` compares all.
void compareColours(const Picture& drawn, const Picture& reference,
  const std::vector<std::uint8_t>& coverage, PictureComparison& result)
{
  std::uint64_t squares = 0; // exact: at most 3 * 255^2 a pixel
  std::uint64_t over = 0;
  std::uint64_t greys = 0; // thousandths
  result.identical = true;
  for (std::size_t i = 0; i < reference.pixels(); ++i)
  {
    const std::uint8_t* a = drawn.rgba.data() + 4 * i;
    const std::uint8_t* b = reference.rgba.data() + 4 * i;
    int largest = 0;
    std::uint64_t square = 0;
    int grey = 0;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      const int difference = std::abs(int(a[channel]) - int(b[channel]));
      grey += greyThousandths[channel] * (int(a[channel]) - int(b[channel]));
      largest = std::max(largest, difference);
      square += std::uint64_t(difference * difference);
    }
    result.identical = result.identical && largest == 0;
    if (coverage.empty() || coverage[i] >= half)
    {
      ++result.pixels;
      squares += square;
      over += largest > noticeable ? 1 : 0;
      greys += std::uint64_t(std::abs(grey));
    }
  }
  if (result.pixels != 0)
  {
    const double meanSquare = double(squares) / (3.0 * double(result.pixels));
    result.psnrDecibels = squares == 0 ? std::numeric_limits<double>::infinity()
                                       : 10.0 * std::log10(255.0 * 255.0 / meanSquare);
    result.shareOver8 = double(over) / double(result.pixels);
    result.meanDifference = 1e-3 * double(greys) / double(result.pixels);
  }
}

void compareStructure(const Picture& drawn, const Picture& reference,
  const std::vector<std::uint8_t>& coverage, PictureComparison& result)
{
  double sum = 0.0;
  structuralSimilarity(drawn, reference,
    [&](std::uint32_t row, const double* values)
    {
      const std::size_t first = std::size_t(row) * reference.width;
      for (std::size_t x = 0; x < reference.width; ++x)
      {
        sum += coverage.empty() || coverage[first + x] >= half ? values[x] : 0.0;
      }
    });
  result.ssim = sum / double(result.pixels);
}

void compareCoverage(const Picture& drawn, const std::vector<std::uint8_t>& coverage,
  const Colour& background, PictureComparison& result)
{
  std::uint64_t holes = 0;
  std::uint64_t bloat = 0;
  for (std::size_t i = 0; i < coverage.size(); ++i)
  {
    const bool empty = isBackground(drawn.rgba.data() + 4 * i, background);
    holes += coverage[i] == full && empty ? 1 : 0;
    bloat += coverage[i] == 0 && !empty ? 1 : 0;
  }
  result.holes = 100.0 * double(holes) / double(result.pixels);
  result.bloat = 100.0 * double(bloat) / double(result.pixels);
  result.background = background;
}
} // namespace

Result<PictureComparison> comparePictures(
  const Picture& drawn, const Picture& reference, const ComparisonOptions& options)
{
  if (Result<void> done = checkSizes(drawn, reference, options); !done)
  {
    return done.error();
  }
  std::vector<std::uint8_t> coverage;
  std::optional<Colour> background = options.background;
  if (options.mask != nullptr)
  {
    coverage = coverageOf(*options.mask);
    if (!background)
    {
      const Result<Colour> found = backgroundOutside(reference, coverage);
      if (!found)
      {
        return found.error();
      }
      background = *found;
    }
  }
  else if (background)
  {
    coverage = coverageOfDrawn(reference, *background);
  }
  PictureComparison result;
  compareColours(drawn, reference, coverage, result);
  if (result.pixels == 0)
  {
    return wrong(options.mask != nullptr ? "the mask has no pixel that is at least half white"
                                         : "the reference shows nothing but the background");
  }
  compareStructure(drawn, reference, coverage, result);
  if (background)
  {
    compareCoverage(drawn, coverage, *background, result);
  }
  return result;
}

} // namespace pointfront
