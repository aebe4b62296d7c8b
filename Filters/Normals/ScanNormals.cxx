#include "ScanNormals.h"

#include "pointfront/Base/Infinity.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <optional>

namespace pointfront
{
namespace
{
constexpr double jumpSteps = 10.0; // to another line
constexpr double turnSteps = 3.0; // behind the farthest point of a line
constexpr std::size_t window = 6; // points to either side of where the last search ended
constexpr double leastSine = 0.05; // sine of the angle between a triangle's edges: 3 degrees

glm::dvec2 flat(const glm::dvec3& p)
{
  return { p.x, p.y };
}

/// Median of the horizontal steps that are not zero (several echoes of one pulse may be).
double usualStep(const std::vector<glm::dvec3>& positions)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < positions.size(); ++i)
  {
    const double step = glm::length(flat(positions[i]) - flat(positions[i - 1]));
    if (step > 0.0)
    {
      steps.push_back(step);
    }
  }
  if (steps.empty())
  {
    return 0.0;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// A scan line, and the point of it that was nearest to the point before.
struct Line
{
  std::size_t begin = 0;
  std::size_t end = 0;
  std::optional<std::size_t> nearest = {};
};

/// The point of a line that is nearest to p: looked for near the last one found, for neighbours
/// have neighbours.
std::optional<std::size_t> nearestOf(
  const std::vector<glm::dvec3>& positions, const glm::dvec3& p, Line& line)
{
  std::size_t first = line.begin;
  std::size_t last = line.end;
  if (line.nearest)
  {
    first = *line.nearest - std::min(window, *line.nearest - line.begin);
    last = std::min(line.end, *line.nearest + window + 1);
  }
  double best = infinity;
  for (std::size_t i = first; i < last; ++i)
  {
    const glm::dvec3 d = positions[i] - p;
    if (const double distance = glm::dot(d, d); distance < best)
    {
      best = distance;
      line.nearest = i;
    }
  }
  return line.nearest;
}

/// The nearer one of the neighbours in the line that is not at the same place.
std::optional<glm::dvec3> edgeAlong(
  const std::vector<glm::dvec3>& positions, std::size_t i, const Line& line)
{
  std::optional<glm::dvec3> edge;
  for (const std::size_t other : { i - 1, i + 1 }) // i - 1 of 0 is beyond every end
  {
    if (other < line.begin || other >= line.end)
    {
      continue;
    }
    const glm::dvec3 d = positions[other] - positions[i];
    if (glm::dot(d, d) > 0.0 && (!edge || glm::dot(d, d) < glm::dot(*edge, *edge)))
    {
      edge = d;
    }
  }
  return edge;
}

glm::dvec3 triangleNormal(const std::vector<glm::dvec3>& positions, std::size_t i, const Line& line,
  Line& before, Line& after)
{
  const std::optional<glm::dvec3> along = edgeAlong(positions, i, line);
  glm::dvec3 normal(0.0);
  double nearest = infinity;
  for (Line* neighbour : { &before, &after })
  {
    const auto third = nearestOf(positions, positions[i], *neighbour);
    if (!third || !along)
    {
      continue;
    }
    const glm::dvec3 across = positions[*third] - positions[i];
    const glm::dvec3 product = glm::cross(*along, across);
    const double length = glm::length(product);
    const double distance = glm::length(across);
    if (distance < nearest && length > leastSine * distance * glm::length(*along))
    {
      nearest = distance;
      normal = product / length;
    }
  }
  return normal;
}
} // namespace

std::vector<std::size_t> scanLines(const std::vector<glm::dvec3>& positions)
{
  std::vector<std::size_t> begins;
  const double step = usualStep(positions);
  for (std::size_t begin = 0; begin < positions.size();)
  {
    begins.push_back(begin);
    const glm::dvec2 start = flat(positions[begin]);
    glm::dvec2 direction(0.0);
    double farthest = 0.0;
    std::size_t turn = begin;
    std::size_t next = begin + 1;
    for (; next < positions.size(); ++next)
    {
      const glm::dvec2 p = flat(positions[next]);
      if (glm::length(p - flat(positions[next - 1])) > jumpSteps * step)
      {
        break;
      }
      if (glm::length(p - start) > turnSteps * step && direction == glm::dvec2(0.0))
      {
        direction = glm::normalize(p - start); // the direction of the first few steps
      }
      const double reached = glm::dot(p - start, direction);
      if (reached >= farthest)
      {
        farthest = reached;
        turn = next;
      }
      else if (reached < farthest - turnSteps * step)
      {
        next = turn + 1;
        break;
      }
    }
    begin = next;
  }
  begins.push_back(positions.size());
  return begins;
}

void scanNormals(const std::vector<glm::dvec3>& positions, std::vector<PackedNormal>& normals)
{
  normals.assign(positions.size(), PackedNormal(0));
  const std::vector<std::size_t> begins = scanLines(positions);
  const std::size_t lines = begins.size() - 1;
  for (std::size_t l = 0; l < lines; ++l)
  {
    const Line line{ begins[l], begins[l + 1] };
    Line before{ l > 0 ? begins[l - 1] : 0, begins[l] };
    Line after{ begins[l + 1], l + 1 < lines ? begins[l + 2] : begins[l + 1] };
    for (std::size_t i = line.begin; i < line.end; ++i)
    {
      normals[i] = facingUp(packNormal(triangleNormal(positions, i, line, before, after)));
    }
  }
}

} // namespace pointfront
