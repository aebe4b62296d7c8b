#include "pointfront/Front/View.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{

/// Row of a matrix: the linear form that gives one clip coordinate.
glm::dvec4 row(const glm::dmat4& m, int r)
{
  return { m[0][r], m[1][r], m[2][r], m[3][r] };
}

glm::dvec3 gradient(const glm::dvec4& form)
{
  return glm::dvec3(form);
}

double at(const glm::dvec4& form, const glm::dvec3& p)
{
  return glm::dot(gradient(form), p) + form.w;
}

/// The point where three linear forms have the values `values`. Rows are scaled to unit length
/// first, so that a narrow view angle (long x and y rows) does not spoil the elimination.
glm::dvec3 solve(
  const std::array<glm::dvec4, 3>& forms, const std::array<double, 3>& values = { 0.0, 0.0, 0.0 })
{
  glm::dmat3 rows(1.0);
  glm::dvec3 right(0.0);
  for (int i = 0; i < 3; ++i)
  {
    const double length = glm::length(gradient(forms[i]));
    const double scale = length > 0.0 ? 1.0 / length : 1.0;
    for (int c = 0; c < 3; ++c)
    {
      rows[c][i] = forms[i][c] * scale;
    }
    right[i] = (values[i] - forms[i].w) * scale;
  }
  return glm::inverse(rows) * right;
}

/// A plane that nothing is beyond, at right angles to `normal`.
glm::dvec4 infinitelyFar(const glm::dvec3& normal)
{
  return glm::dvec4(normal, std::numeric_limits<double>::max());
}

glm::dvec4 normalised(const glm::dvec4& plane)
{
  return plane / glm::length(gradient(plane));
}

/// Gribb & Hartmann 2001: a clip plane is the sum or difference of two rows. The difference of
/// the z and w rows cancels when far / near is beyond what a double resolves: the plane is
/// then farther than the matrix can say.
std::array<glm::dvec4, 6> clipPlanes(
  const std::array<glm::dvec4, 4>& rows, const glm::dvec3& direction)
{
  std::array<glm::dvec4, 6> planes{};
  for (int axis = 0; axis < 3; ++axis)
  {
    planes[2 * axis] = rows[3] + rows[axis];
    planes[2 * axis + 1] = rows[3] - rows[axis];
    const double scale = glm::length(gradient(rows[3])) + glm::length(gradient(rows[axis]));
    for (int side = 0; side < 2; ++side)
    {
      glm::dvec4& plane = planes[2 * axis + side];
      const double length = glm::length(gradient(plane));
      const bool resolved = length > 1e-14 * scale && std::isfinite(length);
      const glm::dvec3 inward = axis == 2 && side == 1 ? -direction : direction;
      plane = resolved ? plane / length : infinitelyFar(inward);
    }
  }
  return planes;
}

/// Pixels of one world unit across the line of sight, the larger of both screen axes. Off-axis
/// frusta lean their x and y rows along the line of sight: that part is no size on screen.
double pixelsAcross(
  const std::array<glm::dvec4, 4>& rows, const glm::dvec3& direction, int width, int height)
{
  const auto across = [&](const glm::dvec4& form)
  { return glm::length(gradient(form) - direction * glm::dot(gradient(form), direction)); };
  return std::max(0.5 * width * across(rows[0]), 0.5 * height * across(rows[1]));
}

} // namespace

std::optional<ModelStretch> ModelStretch::of(const glm::dmat4& modelToWorld)
{
  constexpr double roundingOfAMatrix = 1e-9;
  ModelStretch stretch;
  stretch.toWorld = glm::dmat3(modelToWorld);
  stretch.squares = stretch.toWorld * glm::transpose(stretch.toWorld);
  const glm::dmat3& m = stretch.squares;
  const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
  double farthest = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    for (int r = 0; r < 3; ++r)
    {
      farthest = std::max(farthest, std::abs(m[c][r] - (c == r ? mean : 0.0)));
    }
  }
  if (!(farthest > roundingOfAMatrix * mean))
  {
    return std::nullopt;
  }
  // Columns of the adjugate of a symmetric matrix.
  stretch.adjugate =
    glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return stretch;
}

double ModelStretch::along(const glm::dvec3& ray) const
{
  return std::sqrt(std::max(0.0, glm::dot(ray, squares * ray)));
}

/// The larger singular value of `toWorld` without its part along the ray: the squares of both have
/// this sum and this product.
double ModelStretch::across(const glm::dvec3& ray) const
{
  const double sum = squares[0][0] + squares[1][1] + squares[2][2] - glm::dot(ray, squares * ray);
  const double product = glm::dot(ray, adjugate * ray);
  return std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * product))));
}

bool operator==(const ModelStretch& a, const ModelStretch& b)
{
  return a.toWorld == b.toWorld && a.direction == b.direction;
}

bool operator==(const View& a, const View& b)
{
  return a.position == b.position && a.direction == b.direction && a.parallel == b.parallel &&
    a.pixelsPerUnit == b.pixelsPerUnit && a.nearDistance == b.nearDistance && a.width == b.width &&
    a.height == b.height && a.planes == b.planes && a.stretch == b.stretch;
}

View View::fromMatrix(const glm::dmat4& worldToClip, int width, int height)
{
  View view;
  view.width = std::max(width, 1);
  view.height = std::max(height, 1);
  std::array<glm::dvec4, 4> rows{ row(worldToClip, 0), row(worldToClip, 1), row(worldToClip, 2),
    row(worldToClip, 3) };
  const double across = std::max(glm::length(gradient(rows[0])), glm::length(gradient(rows[1])));
  const double depthScale = glm::length(gradient(rows[3]));
  view.parallel = depthScale <= 1e-13 * across;

  // The matrix is known up to a factor: choose it so that w is the depth (perspective) or one.
  const double factor = view.parallel ? 1.0 / rows[3].w : 1.0 / depthScale;
  for (glm::dvec4& r : rows)
  {
    r *= factor;
  }
  if (view.parallel)
  {
    rows[3] = { 0.0, 0.0, 0.0, 1.0 };
    view.direction = glm::normalize(gradient(rows[2]));
    view.nearDistance = 1.0;
    view.position =
      solve({ rows[0], rows[1], rows[2] }, { 0.0, 0.0, -1.0 }) - view.nearDistance * view.direction;
  }
  else
  {
    // All of x, y and w vanish at the eye and nowhere else.
    view.direction = gradient(rows[3]);
    view.position = solve({ rows[0], rows[1], rows[3] });
    // Along the line of sight z = a t + b and w = t; the near plane is where z = -w.
    const double a = glm::dot(gradient(rows[2]), view.direction);
    const double b = at(rows[2], view.position);
    const double nearDistance = -b / (1.0 + a);
    view.nearDistance = nearDistance > 0.0 && std::isfinite(nearDistance)
      ? nearDistance
      : std::numeric_limits<double>::min();
  }
  view.pixelsPerUnit = pixelsAcross(rows, view.direction, view.width, view.height);
  view.planes = clipPlanes(rows, view.direction);
  return view;
}

View View::ofModel(
  const glm::dmat4& modelToWorld, const glm::dmat4& worldToClip, int width, int height)
{
  View view = fromMatrix(worldToClip * modelToWorld, width, height);
  view.stretch = ModelStretch::of(modelToWorld);
  if (view.stretch)
  {
    const View world = fromMatrix(worldToClip, width, height);
    const glm::dmat3& squares = view.stretch->squares;
    const double most = std::sqrt(squares[0][0] + squares[1][1] + squares[2][2]);
    view.stretch->direction = world.direction;
    view.pixelsPerUnit =
      world.pixelsPerUnit * (world.parallel ? view.stretch->across(world.direction) : 1.0);
    view.nearDistance = world.nearDistance / std::max(most, 1.0); // a distance may be as short
  }
  return view;
}

View View::perspective(const glm::dvec3& position, const glm::dvec3& focalPoint,
  const glm::dvec3& up, double verticalAngle, double nearDistance, double farDistance, int width,
  int height)
{
  const glm::dvec3 direction = glm::normalize(focalPoint - position);
  glm::dvec3 right = glm::cross(direction, up);
  if (glm::dot(right, right) < 1e-24 * glm::dot(up, up))
  {
    // Looking along `up`: any other axis will do.
    const glm::dvec3 other =
      std::abs(direction.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    right = glm::cross(direction, other);
  }
  right = glm::normalize(right);
  const glm::dvec3 upward = glm::cross(right, direction);

  View view;
  view.width = std::max(width, 1);
  view.height = std::max(height, 1);
  view.position = position;
  view.direction = direction;
  view.nearDistance = nearDistance;
  const double tangentY = std::tan(0.5 * verticalAngle);
  const double tangentX = tangentY * view.width / view.height;
  view.pixelsPerUnit = 0.5 * view.height / tangentY;
  const auto through = [&](const glm::dvec3& normal, const glm::dvec3& point)
  { return normalised(glm::dvec4(normal, -glm::dot(normal, point))); };
  view.planes = { through(right + tangentX * direction, position),
    through(-right + tangentX * direction, position),
    through(upward + tangentY * direction, position),
    through(-upward + tangentY * direction, position),
    through(direction, position + nearDistance * direction),
    through(-direction, position + farDistance * direction) };
  return view;
}

} // namespace pointfront
