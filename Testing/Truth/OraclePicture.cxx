#include "OraclePicture.h"

#include "ParallelRows.h"
#include "SolidTexture.h"

#include "pointfront/Neighbourhood/KdIndex.h"

#include <algorithm>
#include <cmath>

namespace pointfront::truth
{
namespace
{
constexpr std::uint32_t neighbours = 12;
constexpr double radiusSpacings = 1.5;
constexpr double nearestWeighs = 1.05; // times its distance: a point alone has some weight

glm::dvec3 meanColour(const NeighbourList& near, const TruthPoints& points, double radius)
{
  const double nearest = near.entries().front().squaredDistance;
  const double squaredRadius =
    std::max({ radius * radius, nearestWeighs * nearestWeighs * nearest, 1e-300 });
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (const NeighbourList::Entry& entry : near.entries())
  {
    const double share = std::max(0.0, 1.0 - entry.squaredDistance / squaredRadius);
    const auto& colour = points.colours[entry.index];
    sum += share * share * glm::dvec3(colour[0], colour[1], colour[2]);
    weights += share * share;
  }
  return sum / weights;
}
} // namespace

Picture drawOracle(const TruthPicture& truth, const PixelRays& pixels, const SpacingGrade& grade,
  const TruthPoints& points)
{
  const PositionSet places{ points.positions, std::vector<std::uint32_t>(points.size(), 1) };
  const KdIndex index(places, 3);
  Picture picture{ pixels.width(), pixels.height(), {} };
  picture.rgba.assign(4 * picture.pixels(), 255);
  forEachRow(picture.height, 0,
    [&](std::size_t row)
    {
      NeighbourList near(neighbours);
      for (std::uint32_t column = 0; column < picture.width; ++column)
      {
        const std::size_t at = row * picture.width + column;
        auto colour = background;
        const double depth = truth.depth[at];
        if (std::isfinite(depth) && points.size() != 0)
        {
          near.begin(places);
          const glm::dvec3 ray = pixels.through(column + 0.5, double(row) + 0.5);
          index.search(pixels.eye() + depth * ray, near);
          const double radius =
            std::max(radiusSpacings * grade.at(depth), depth / pixels.focalPx());
          colour = toBytes(meanColour(near, points, radius));
        }
        std::copy(colour.begin(), colour.end(), picture.rgba.begin() + std::ptrdiff_t(4 * at));
      }
    });
  return picture;
}

} // namespace pointfront::truth
