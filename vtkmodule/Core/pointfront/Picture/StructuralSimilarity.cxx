#include "pointfront/Picture/StructuralSimilarity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pointfront
{
namespace
{
constexpr int radius = 5; // radius of a window of 11 pixels
constexpr std::size_t windowRows = 2 * std::size_t(radius) + 1;
constexpr double sigma = 1.5;
constexpr double stabiliser1 = (0.01 * 255.0) * (0.01 * 255.0);
constexpr double stabiliser2 = (0.03 * 255.0) * (0.03 * 255.0);

/// The moments that are averaged over a window.
enum Moment : std::size_t
{
  One,
  Other,
  OneSquared,
  OtherSquared,
  Product,
  MomentCount
};

std::array<double, windowRows> gaussianWeights()
{
  std::array<double, windowRows> weights{};
  double sum = 0.0;
  for (std::size_t i = 0; i < windowRows; ++i)
  {
    const double offset = double(i) - radius;
    weights[i] = std::exp(-(offset * offset) / (2.0 * sigma * sigma));
    sum += weights[i];
  }
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

double grey(const std::uint8_t* rgb)
{
  return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}

/// The moments of the rows around one row, smoothed along the rows: each row is smoothed once and
/// kept while a window reaches it.
class MomentRows
{
public:
  MomentRows(const Picture& one, const Picture& other)
    : one_(one)
    , other_(other)
    , paddedWidth_(std::size_t(one.width) + windowRows - 1)
    , padded_(MomentCount * paddedWidth_)
    , ring_(windowRows * MomentCount * one.width)
  {
  }

  /// Rows come in ascending order.
  void reach(std::uint32_t row)
  {
    for (; next_ <= row; ++next_)
    {
      smooth(next_);
    }
  }
  const double* at(std::uint32_t row, Moment moment) const
  {
    return ring_.data() + ((row % windowRows) * MomentCount + moment) * one_.width;
  }

private:
  void smooth(std::uint32_t row)
  {
    for (std::size_t x = 0; x < paddedWidth_; ++x)
    {
      const auto column = std::uint32_t(
        std::clamp<std::ptrdiff_t>(std::ptrdiff_t(x) - radius, 0, std::ptrdiff_t(one_.width) - 1));
      const double a = grey(one_.pixel(column, row));
      const double b = grey(other_.pixel(column, row));
      padded_[One * paddedWidth_ + x] = a;
      padded_[Other * paddedWidth_ + x] = b;
      padded_[OneSquared * paddedWidth_ + x] = a * a;
      padded_[OtherSquared * paddedWidth_ + x] = b * b;
      padded_[Product * paddedWidth_ + x] = a * b;
    }
    for (std::size_t moment = 0; moment < MomentCount; ++moment)
    {
      double* target = ring_.data() + ((row % windowRows) * MomentCount + moment) * one_.width;
      std::fill_n(target, one_.width, 0.0);
      for (std::size_t i = 0; i < windowRows; ++i)
      {
        const double* source = padded_.data() + moment * paddedWidth_ + i;
        for (std::size_t x = 0; x < one_.width; ++x)
        {
          target[x] += weights_[i] * source[x];
        }
      }
    }
  }

  const Picture& one_;
  const Picture& other_;
  std::size_t paddedWidth_;
  std::array<double, windowRows> weights_ = gaussianWeights();
  std::vector<double> padded_;
  std::vector<double> ring_;
  std::uint32_t next_ = 0;
};

double similarity(const std::array<double, MomentCount>& mean)
{
  const double a = mean[One];
  const double b = mean[Other];
  const double varianceA = mean[OneSquared] - a * a;
  const double varianceB = mean[OtherSquared] - b * b;
  const double covariance = mean[Product] - a * b;
  return (2.0 * a * b + stabiliser1) * (2.0 * covariance + stabiliser2) /
    ((a * a + b * b + stabiliser1) * (varianceA + varianceB + stabiliser2));
}
} // namespace

void structuralSimilarity(const Picture& one, const Picture& other,
  const std::function<void(std::uint32_t row, const double* values)>& each)
{
  assert(one.width == other.width && one.height == other.height);
  const std::array<double, windowRows> weights = gaussianWeights();
  const auto lastRow = std::ptrdiff_t(one.height) - 1;
  MomentRows rows(one, other);
  std::array<std::vector<double>, MomentCount> sums;
  std::vector<double> values(one.width);
  for (std::uint32_t row = 0; row < one.height; ++row)
  {
    for (std::vector<double>& sum : sums)
    {
      sum.assign(one.width, 0.0);
    }
    for (std::size_t i = 0; i < windowRows; ++i)
    {
      const std::ptrdiff_t wanted = std::ptrdiff_t(row) + std::ptrdiff_t(i) - radius;
      const auto source = std::uint32_t(std::clamp<std::ptrdiff_t>(wanted, 0, lastRow));
      rows.reach(source);
      for (std::size_t moment = 0; moment < MomentCount; ++moment)
      {
        const double* smoothed = rows.at(source, Moment(moment));
        for (std::size_t x = 0; x < one.width; ++x)
        {
          sums[moment][x] += weights[i] * smoothed[x];
        }
      }
    }
    for (std::size_t x = 0; x < one.width; ++x)
    {
      values[x] = similarity({ sums[One][x], sums[Other][x], sums[OneSquared][x],
        sums[OtherSquared][x], sums[Product][x] });
    }
    each(row, values.data());
  }
}

} // namespace pointfront
