#include "pointfront/Trees/SparsePoints.h"

#include "pointfront/Records/MortonOrder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pointfront
{
namespace
{
constexpr double sparseShare = 1.0 / 50.0;
constexpr double spacingOfSide = 0.4;
constexpr unsigned mostBits = 32;

/// Counts places by the bits in which they differ from the nearer of their neighbours on the curve:
/// a place is alone in all smaller cells.
class LonePlaces
{
public:
  /// The next place differs from the one before in so many bits.
  void add(unsigned bits)
  {
    ++count_[std::min(before_, bits)];
    before_ = bits;
  }
  /// Behind the last place nothing is near.
  void end() { add(mostBits + 1); }
  double shareOf(std::uint64_t places, unsigned log2Side) const
  {
    std::uint64_t alone = 0;
    for (unsigned bits = log2Side + 1; bits < count_.size(); ++bits)
    {
      alone += count_[bits];
    }
    return static_cast<double>(alone) / static_cast<double>(places);
  }

private:
  std::array<std::uint64_t, mostBits + 2> count_{};
  unsigned before_ = mostBits + 1;
};
} // namespace

double sparseSpacing(const RecordSpan& positions, const std::vector<std::uint32_t>& points)
{
  LonePlaces lone;
  std::uint64_t places = 1;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const unsigned bits =
      differingBits(positions.position(points[i - 1]), positions.position(points[i]));
    if (bits > 0)
    {
      lone.add(bits);
      ++places;
    }
  }
  lone.end();
  if (places == 1)
  {
    return 0.0;
  }
  unsigned log2Side = 0;
  double share = lone.shareOf(places, 0);
  double next = lone.shareOf(places, 1);
  while (next >= sparseShare && log2Side + 1 < mostBits)
  {
    share = next;
    next = lone.shareOf(places, ++log2Side + 1);
  }
  const double between = next < share ? (share - sparseShare) / (share - next) : 0.0;
  const double side = std::ldexp(1.0 + std::min(between, 1.0), static_cast<int>(log2Side));
  return spacingOfSide * side;
}

} // namespace pointfront
