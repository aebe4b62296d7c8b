#include "TruthPoints.h"

#include "PoissonOrder.h"
#include "RandomStream.h"

#include <algorithm>
#include <cmath>

namespace pointfront::truth
{
namespace
{
constexpr double candidatesPerSquare = 6.0; // candidates in a square of the spacing
constexpr double radiusPerSpacing = 0.713; // gives one point a square, by experiment

/// A place on a triangle, as Hit has it.
struct Place
{
  double b = 0.0;
  double c = 0.0;
};

/// Random places on the surface, with one density wherever one spacing is asked for.
class Candidates
{
public:
  Candidates(const SamplingRegion& region, std::uint64_t seed)
    : region_(region)
    , mesh_(region.rays.mesh())
    , random_(seed)
  {
    for (std::size_t triangle = 0; triangle < mesh_.size(); ++triangle)
    {
      fill(triangle, { 0, 0 }, { 1, 0 }, { 0, 1 });
    }
  }

  std::vector<glm::dvec3> positions;
  std::vector<double> radii;
  std::vector<std::uint32_t> triangles;
  std::vector<Place> places;

private:
  glm::dvec3 at(std::size_t triangle, const Place& place) const
  {
    const glm::dvec3& corner = mesh_.corner(triangle, 0);
    return corner + place.b * (mesh_.corner(triangle, 1) - corner) +
      place.c * (mesh_.corner(triangle, 2) - corner);
  }

  /// A piece of a triangle: leaves it out, divides it, or scatters candidates over it.
  void fill(std::size_t triangle, const Place& p, const Place& q, const Place& r)
  {
    const glm::dvec3 corners[3] = { at(triangle, p), at(triangle, q), at(triangle, r) };
    const glm::dvec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    double radius = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : corners)
    {
      radius = std::max(radius, glm::length(corner - centre));
      nearest = std::min(nearest, region_.pixels.project(corner).z);
    }
    if (!region_.pixels.mayShow(centre, radius, region_.marginPx()))
    {
      return;
    }
    const SpacingGrade& grade = region_.grade;
    const double spacing = grade.at(std::max(nearest, grade.nearest()));
    // Over a piece that reaches far in depth the finest spacing would waste most candidates.
    const double depth = region_.pixels.project(centre).z;
    if (grade.graded && radius > 0.25 * depth && radius > 0.02 * grade.spacing)
    {
      divide(triangle, p, q, r, corners);
      return;
    }
    const double area =
      0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    scatter(triangle, p, q, r, spacing, area);
  }

  /// Halves the longest edge.
  void divide(std::size_t triangle, const Place& p, const Place& q, const Place& r,
    const glm::dvec3 (&corners)[3])
  {
    const auto middle = [](const Place& one, const Place& other) {
      return Place{ 0.5 * (one.b + other.b), 0.5 * (one.c + other.c) };
    };
    const double pq = glm::length(corners[1] - corners[0]);
    const double qr = glm::length(corners[2] - corners[1]);
    const double rp = glm::length(corners[0] - corners[2]);
    if (pq >= qr && pq >= rp)
    {
      const Place half = middle(p, q);
      fill(triangle, p, half, r);
      fill(triangle, half, q, r);
    }
    else if (qr >= rp)
    {
      const Place half = middle(q, r);
      fill(triangle, p, q, half);
      fill(triangle, p, half, r);
    }
    else
    {
      const Place half = middle(r, p);
      fill(triangle, p, q, half);
      fill(triangle, half, q, r);
    }
  }

  void scatter(std::size_t triangle, const Place& p, const Place& q, const Place& r, double spacing,
    double area)
  {
    const auto count =
      std::uint64_t(candidatesPerSquare * area / (spacing * spacing) + random_.uniform());
    for (std::uint64_t i = 0; i < count; ++i)
    {
      double u = random_.uniform();
      double v = random_.uniform();
      if (u + v > 1.0)
      {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const double keep = random_.uniform();
      const Place place = { p.b + u * (q.b - p.b) + v * (r.b - p.b),
        p.c + u * (q.c - p.c) + v * (r.c - p.c) };
      const glm::dvec3 position = at(triangle, place);
      if (!region_.contains(position))
      {
        continue;
      }
      const double wanted = region_.grade.at(region_.pixels.project(position).z);
      if (keep * wanted * wanted <= spacing * spacing)
      {
        positions.push_back(position);
        radii.push_back(radiusPerSpacing * wanted);
        triangles.push_back(std::uint32_t(triangle));
        places.push_back(place);
      }
    }
  }

  const SamplingRegion& region_;
  const TriangleMesh& mesh_;
  RandomStream random_;
};
} // namespace

TruthPoints sampleBlueNoise(const SamplingRegion& region, std::uint64_t seed)
{
  const Candidates candidates(region, seed);
  const TriangleMesh& mesh = region.rays.mesh();
  TruthPoints points;
  for (std::uint32_t index : poissonOrder(candidates.positions, candidates.radii, seed + 1))
  {
    const std::uint32_t triangle = candidates.triangles[index];
    const Place& place = candidates.places[index];
    points.add(mesh, triangle, place.b, place.c, candidates.positions[index],
      mesh.normalAt(triangle, place.b, place.c));
  }
  return points;
}

} // namespace pointfront::truth
