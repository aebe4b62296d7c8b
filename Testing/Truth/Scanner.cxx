#include "TruthPoints.h"

#include "ParallelRows.h"
#include "RandomStream.h"

#include <algorithm>
#include <cmath>

namespace pointfront::truth
{
namespace
{
constexpr double linesPerPoints = 2.0; // distance of two lines over that of two points in one
constexpr double alongJitter = 0.08; // share of the distance of points, standard deviation
constexpr double acrossJitter = 0.03; // share of the distance of lines
constexpr double lineSway = 0.1; // share of the distance of lines
constexpr double rangeNoise = 0.1; // share of the spacing
constexpr double outlierShare = 0.01;
constexpr double outlierNoise = 1.0; // share of the spacing
constexpr double leastCosine = 0.35; // flatter hits on a single object are lost

/// Parallel beams over the whole scene.
struct Flight
{
  glm::dvec3 beam;
  glm::dvec3 along; ///< direction of a scan line
  glm::dvec3 across; ///< from one line to the next
  double widening; ///< times the spacing: less than 1 where several flights meet
};

Flight makeFlight(const glm::dvec3& beam, double widening, bool turned)
{
  const glm::dvec3 down = glm::normalize(beam);
  const glm::dvec3 aside = std::abs(down.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(down, aside));
  const glm::dvec3 v = glm::cross(down, u);
  return turned ? Flight{ down, v, u, widening } : Flight{ down, u, v, widening };
}

std::vector<Flight> flightsOver(bool town)
{
  std::vector<Flight> flights;
  if (town)
  {
    flights.push_back(makeFlight({ 0.02, 0.03, -1.0 }, 1.22, false));
    for (int k = 0; k < 4; ++k)
    {
      const double heading = 0.3 + 0.5 * pi * k;
      flights.push_back(
        makeFlight({ 0.7 * std::cos(heading), 0.7 * std::sin(heading), -1.0 }, 2.44, k % 2 == 1));
    }
    return flights;
  }
  const glm::dvec3 x = glm::normalize(glm::dvec3(0.8, 0.36, 0.48));
  const glm::dvec3 y =
    glm::normalize(glm::dvec3(-0.6, 0.48, 0.64) - x * glm::dot(x, glm::dvec3(-0.6, 0.48, 0.64)));
  for (const glm::dvec3& axis : { x, y, glm::cross(x, y) })
  {
    flights.push_back(makeFlight(axis, 1.08, false));
    flights.push_back(makeFlight(-axis, 1.08, true));
  }
  return flights;
}

/// From low to high, of places that are added.
struct Range
{
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void clip(const Range& other)
  {
    low = std::max(low, other.low);
    high = std::min(high, other.high);
  }
  bool empty() const { return !(low <= high); }
};

std::array<glm::dvec3, 8> cornersOf(const Bounds& box)
{
  std::array<glm::dvec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k)
  {
    corners[k] = { (k & 1) != 0 ? box.high.x : box.low.x, (k & 2) != 0 ? box.high.y : box.low.y,
      (k & 4) != 0 ? box.high.z : box.low.z };
  }
  return corners;
}

/// One flight's points of one level of spacing.
class Scan
{
public:
  Scan(const SamplingRegion& region, const Flight& flight, int level, bool town)
    : region_(region)
    , flight_(flight)
    , level_(level)
    , town_(town)
    , spacing_(region.grade.ofLevel(level))
    , step_(flight.widening * spacing_ / std::sqrt(linesPerPoints))
    , lineStep_(linesPerPoints * step_)
  {
    for (const glm::dvec3& corner : cornersOf(region.rays.mesh().bounds()))
    {
      along_.add(glm::dot(corner, flight.along));
      across_.add(glm::dot(corner, flight.across));
      start_ = std::min(start_, glm::dot(corner, flight.beam));
    }
    clipToView();
  }

  void run(std::uint64_t seed, TruthPoints& points) const
  {
    if (along_.empty() || across_.empty())
    {
      return;
    }
    const auto first = std::int64_t(std::floor(across_.low / lineStep_));
    const auto last = std::int64_t(std::ceil(across_.high / lineStep_));
    std::vector<TruthPoints> lines(std::size_t(last - first + 1));
    forEachRow(lines.size(), 0,
      [&](std::size_t row)
      { scanLine(first + std::int64_t(row), hashOf(seed ^ hashOf(row)), lines[row]); });
    for (const TruthPoints& line : lines)
    {
      points.append(line);
    }
  }

private:
  /// Beams that can meet what is seen at the depths of this level.
  void clipToView()
  {
    const PixelRays& pixels = region_.pixels;
    const SpacingGrade& grade = region_.grade;
    double far = 0.0;
    for (const glm::dvec3& corner : cornersOf(region_.rays.mesh().bounds()))
    {
      far = std::max(far, pixels.project(corner).z);
    }
    double near = grade.nearest();
    if (grade.graded)
    {
      far = std::min(far, grade.medianDepth * std::exp2(level_ + 0.5));
      near = std::max(near, grade.medianDepth * std::exp2(level_ - 0.5));
    }
    Range along;
    Range across;
    const double margin = region_.marginPx();
    for (double depth : { near, far })
    {
      for (double x : { -margin, pixels.width() + margin })
      {
        for (double y : { -margin, pixels.height() + margin })
        {
          const glm::dvec3 place = pixels.eye() + depth * pixels.through(x, y);
          along.add(glm::dot(place, flight_.along));
          across.add(glm::dot(place, flight_.across));
        }
      }
    }
    along_.clip(along);
    across_.clip(across);
  }

  void scanLine(std::int64_t line, std::uint64_t seed, TruthPoints& points) const
  {
    RandomStream random(seed);
    const auto first = std::int64_t(std::floor(along_.low / step_));
    const auto last = std::int64_t(std::ceil(along_.high / step_));
    for (std::int64_t i = first; i <= last; ++i)
    {
      const double u = step_ * (double(i) + alongJitter * random.gaussian());
      const double sway = lineSway * std::sin(0.01 * double(i));
      const double v = lineStep_ * (double(line) + acrossJitter * random.gaussian() + sway);
      const bool outlier = random.uniform() < outlierShare;
      const double noise = (outlier ? outlierNoise : rangeNoise) * random.gaussian();
      shoot(u * flight_.along + v * flight_.across + (start_ - 1.0) * flight_.beam, noise, points);
    }
  }

  void shoot(const glm::dvec3& from, double noise, TruthPoints& points) const
  {
    const Hit hit = region_.rays.cast(from, flight_.beam);
    if (!hit)
    {
      return;
    }
    const glm::dvec3 place = from + hit.distance * flight_.beam;
    if (!region_.contains(place) || region_.grade.level(region_.pixels.project(place).z) != level_)
    {
      return;
    }
    const TriangleMesh& mesh = region_.rays.mesh();
    const glm::dvec3 normal = mesh.normalAt(hit.triangle, hit.b, hit.c);
    const double cosine = -glm::dot(normal, flight_.beam);
    if (town_ || std::abs(cosine) >= leastCosine)
    {
      points.add(mesh, hit.triangle, hit.b, hit.c, place + noise * spacing_ * flight_.beam,
        cosine < 0.0 ? -normal : normal); // as a scanner knows it: towards itself
    }
  }

  const SamplingRegion& region_;
  const Flight& flight_;
  int level_;
  bool town_;
  double spacing_;
  double step_;
  double lineStep_;
  double start_ = std::numeric_limits<double>::infinity();
  Range along_;
  Range across_;
};
} // namespace

TruthPoints sampleByScanner(const SamplingRegion& region, bool town, std::uint64_t seed)
{
  double far = region.grade.nearest();
  for (const glm::dvec3& corner : cornersOf(region.rays.mesh().bounds()))
  {
    far = std::max(far, region.pixels.project(corner).z);
  }
  TruthPoints points;
  std::uint64_t part = 0;
  for (const Flight& flight : flightsOver(town))
  {
    const int last = region.grade.level(far);
    for (int level = region.grade.level(region.grade.nearest()); level <= last; ++level)
    {
      Scan(region, flight, level, town).run(hashOf(seed + hashOf(part++)), points);
    }
  }
  return points;
}

} // namespace pointfront::truth
