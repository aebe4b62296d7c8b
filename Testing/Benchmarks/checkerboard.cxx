// usage: pointfrontCheckerboardBenchmark
//
// A checkerboard seen at a slant, near squares of many pixels, far ones of less than one, by each
// technique of the software rasteriser, against the true picture (64 rays a pixel): PSNR in dB over
// the board, its farthest quarter of rows apart from the others. Points are a jittered grid,
// coloured by the square that they lie in; splats have what closes that grid.

#include "PlanOfPoints.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace
{

using namespace pointfront;
using namespace pointfront::test;

constexpr int width = 640;
constexpr int height = 360;
constexpr int rays = 8; // a pixel and axis
constexpr double board = 20.0; // half of an edge
constexpr double square = 0.5;
constexpr double spacing = 0.05;
constexpr double angle = 0.8;
const glm::dvec3 eye(0.0, -21.0, 2.0);
const glm::dvec3 focus(0.0, -12.0, 0.0);

bool isWhite(double x, double y)
{
  const auto column = static_cast<int>(std::floor(x / square));
  const auto row = static_cast<int>(std::floor(y / square));
  return (column + row) % 2 == 0;
}

/// Finds the square that a ray through the viewport meets. False: it misses the board.
bool meets(double px, double py, bool& white)
{
  const glm::dvec3 ahead = glm::normalize(focus - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 0, 1)));
  const glm::dvec3 up = glm::cross(right, ahead);
  const double half = std::tan(0.5 * angle);
  const double x = (px - 0.5 * width) / (0.5 * height) * half;
  const double y = (py - 0.5 * height) / (0.5 * height) * half;
  const glm::dvec3 ray = ahead + x * right + y * up;
  const double t = -eye.z / ray.z;
  const glm::dvec3 at = eye + t * ray;
  white = isWhite(at.x, at.y);
  return t > 0.0 && std::abs(at.x) < board - 1.0 && std::abs(at.y) < board - 1.0;
}

/// Grey levels; below 0 where a pixel is not all on the board.
std::vector<double> truth()
{
  std::vector<double> grey(std::size_t(width) * height, -1.0);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      int met = 0, whites = 0;
      for (int ray = 0; ray < rays * rays; ++ray)
      {
        bool white = false;
        met += meets(x + (ray % rays + 0.5) / rays, y + (ray / rays + 0.5) / rays, white);
        whites += white;
      }
      if (met == rays * rays)
      {
        grey[static_cast<std::size_t>(y) * width + x] = 255.0 * whites / met;
      }
    }
  }
  return grey;
}

PlanOfPoints scene()
{
  PlanOfPoints made;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  const int side = static_cast<int>(2.0 * board / spacing);
  std::vector<TestPoint> points;
  for (int i = 0; i < side * side; ++i)
  {
    TestPoint point;
    const double x = (i % side + 0.5 + jitter(random)) * spacing - board;
    const double y = (i / side + 0.5 + jitter(random)) * spacing - board;
    const std::uint8_t grey = isWhite(x, y) ? 255 : 0;
    point.position = { x, y, 0.0 };
    point.normal = { 0.0f, 0.0f, 1.0f };
    point.rgb = { grey, grey, grey };
    points.push_back(point);
  }
  made.add(points, 0.9 * spacing);
  made.look(eye, focus, angle, width, height, 0.1, 1000.0);
  return made;
}

double psnr(const SoftwareTarget& drawn, const std::vector<double>& expected, bool isFar)
{
  int low = height, high = 0;
  for (int y = 0; y < height; ++y)
  {
    const bool any = expected[static_cast<std::size_t>(y) * width + width / 2] >= 0.0;
    low = any ? std::min(low, y) : low;
    high = any ? y + 1 : high;
  }
  const int middle = high - (high - low) / 4; // far squares are small: the uppermost quarter
  double sum = 0.0;
  std::size_t pixels = 0;
  for (int y = isFar ? middle : low; y < (isFar ? high : middle); ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const auto i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const double difference = static_cast<double>(drawn.rgba[i] & 255u) - expected[i];
      sum += expected[i] >= 0.0 ? difference * difference : 0.0;
      pixels += expected[i] >= 0.0;
    }
  }
  return 10.0 * std::log10(255.0 * 255.0 / (sum / static_cast<double>(pixels)));
}

struct Way
{
  const char* name;
  Technique technique;
  SplatAccuracy accuracy;
  SplatSize size;
};

SplatSize pixels(double size)
{
  return { SplatSize::Mode::Pixels, size, 0 };
}

} // namespace

int main()
{
  const SplatSize closing{ SplatSize::Mode::Spacing, 1.0, 0 };
  const std::array<Way, 6> ways{ {
    { "points, 1 px", Technique::Points, SplatAccuracy::Affine, pixels(1.0) },
    { "points, 3 px", Technique::Points, SplatAccuracy::Affine, pixels(3.0) },
    { "ellipses, opaque", Technique::Splats, SplatAccuracy::Affine, closing },
    { "EWA, affine", Technique::Ewa, SplatAccuracy::Affine, closing },
    { "EWA, exact", Technique::Ewa, SplatAccuracy::Exact, closing },
    { "EWA, full", Technique::Ewa, SplatAccuracy::Full, closing },
  } };
  const std::vector<double> reference = truth();
  PlanOfPoints plane = scene();
  std::printf("| | near | far |\n| --- | --- | --- |\n");
  for (const Way& way : ways)
  {
    plane.style->technique = way.technique;
    plane.style->accuracy = way.accuracy;
    plane.style->blended = way.technique == Technique::Ewa;
    plane.style->size = way.size;
    plane.style->normalColumn = 1;
    const SoftwareTarget drawn = plane.draw();
    std::printf("| %s | %.1f | %.1f |\n", way.name, psnr(drawn, reference, false),
      psnr(drawn, reference, true));
  }
  return 0;
}
