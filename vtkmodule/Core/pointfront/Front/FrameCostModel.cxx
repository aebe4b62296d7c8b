#include "pointfront/Front/FrameCostModel.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

constexpr double pointUnit = 1e6;
constexpr double moveUnit = 64.0;
constexpr double decay = 0.95;
constexpr double priorWeight = 0.3;
/// Residuals beyond this many times the typical one are outliers.
constexpr double outlierScale = 3.0;
/// Frames before outliers can be told.
constexpr std::uint64_t learningFrames = 3;
/// Moves are never taken for more than that share of a frame.
constexpr double mostMoveShare = 0.5;
/// Frames that are as near to the target as that, relatively, leave the points as they are.
constexpr double nearTarget = 0.1;

glm::dvec3 features(std::uint64_t points, std::uint32_t moves)
{
  return { double(points) / pointUnit, double(moves) / moveUnit, 1.0 };
}

/// A cost cannot be negative: columns that come out below 0 are fixed there, and the others
/// fitted again without them.
glm::dvec3 solveNonNegative(const glm::dmat3& matrix, const glm::dvec3& right)
{
  glm::dmat3 free = matrix;
  glm::dvec3 target = right;
  glm::dvec3 solution(0.0);
  for (int round = 0; round < 3; ++round)
  {
    solution = glm::inverse(free) * target;
    int worst = 0;
    for (int i = 1; i < 3; ++i)
    {
      worst = solution[i] < solution[worst] ? i : worst;
    }
    if (solution[worst] >= 0.0)
    {
      break;
    }
    for (int i = 0; i < 3; ++i)
    {
      free[i][worst] = free[worst][i] = i == worst ? 1.0 : 0.0;
    }
    target[worst] = 0.0;
  }
  return glm::max(solution, glm::dvec3(0.0));
}

} // namespace

void FrameCostModel::record(std::uint64_t points, std::uint32_t moves, double milliseconds)
{
  if (!(milliseconds > 0.0) || !std::isfinite(milliseconds))
  {
    return;
  }
  const double predicted = predictMs(points, moves);
  const double residual = std::abs(milliseconds - predicted);
  double weight = 1.0;
  if (frames_ >= learningFrames)
  {
    const double far = outlierScale * std::max(scaleMs_, 0.02 * predicted);
    weight = residual > far ? far / residual : 1.0;
    // Grows by a half at most, so that one spike does not hide the next.
    scaleMs_ += 0.1 * (std::min(residual, 6.0 * std::max(scaleMs_, 0.05)) - scaleMs_);
  }
  else
  {
    scaleMs_ = frames_ == 0 ? residual : std::min(scaleMs_, residual);
  }
  const double ownMs =
    milliseconds - std::min(costs_[1] * double(moves) / moveUnit, mostMoveShare * milliseconds);
  const double perPoint = ownMs / std::max(1.0, double(points));
  recentPerPoint_[frames_ % recentPerPoint_.size()] = perPoint;
  if (frames_ == 0)
  {
    recentPerPoint_.fill(perPoint);
  }
  lastPoints_ = double(points);
  ++frames_;

  const glm::dvec3 x = features(points, moves);
  int entry = 0;
  for (int row = 0; row < 3; ++row)
  {
    right_[row] = decay * right_[row] + weight * x[row] * milliseconds;
    for (int column = row; column < 3; ++column, ++entry)
    {
      matrix_[entry] = decay * matrix_[entry] + weight * x[row] * x[column];
    }
  }
  solve();
}

void FrameCostModel::solve()
{
  glm::dmat3 matrix;
  glm::dvec3 right;
  int entry = 0;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = row; column < 3; ++column, ++entry)
    {
      matrix[row][column] = matrix[column][row] = matrix_[entry];
    }
    matrix[row][row] += priorWeight;
    right[row] = right_[row] + priorWeight * prior_[row];
  }
  const glm::dvec3 fitted = solveNonNegative(matrix, right);
  costs_ = { fitted.x, fitted.y, fitted.z };
}

double FrameCostModel::predictMs(std::uint64_t points, std::uint32_t moves) const
{
  return glm::dot(features(points, moves), glm::dvec3(costs_[0], costs_[1], costs_[2]));
}

double FrameCostModel::recentPerPoint() const
{
  const auto [a, b, c] = recentPerPoint_;
  return std::max(std::min(a, b), std::min(std::max(a, b), c)); // the median
}

std::uint64_t FrameCostModel::pointsFor(double targetMs, std::uint64_t floorPoints) const
{
  // Where points cost nothing that can be measured, a hundred times the prior is promised.
  const double fittedPerPoint = std::max(costs_[0], 0.01 * prior_[0]) / pointUnit;
  double points = (targetMs - costs_[2]) / fittedPerPoint;
  if (frames_ > 0)
  {
    const double proportional = targetMs / recentPerPoint();
    const double scale = proportional / std::max(1.0, lastPoints_);
    points = scale >= 1.0 ? proportional
                          : std::clamp(points, proportional * std::sqrt(scale), proportional);
    if (std::abs(scale - 1.0) < nearTarget)
    {
      points = lastPoints_;
    }
    else if (std::abs(std::log2(scale)) < 1.0)
    {
      points = std::sqrt(points * lastPoints_); // half the way
    }
  }
  return std::max(floorPoints, static_cast<std::uint64_t>(std::max(points, 0.0)));
}

std::uint32_t FrameCostModel::movesFor(double targetMs, std::uint64_t points) const
{
  const double perMove = std::max(costs_[1], 1e-3 * prior_[1]) / moveUnit;
  double pointsMs = predictMs(points, 0);
  if (frames_ > 0)
  {
    // The slower times that the fit still holds must not stop the front.
    pointsMs = std::min(pointsMs, 2.0 * recentPerPoint() * double(points));
  }
  const double moves = (targetMs - pointsMs) / perMove;
  return static_cast<std::uint32_t>(std::clamp(moves, 8.0, 4096.0));
}

} // namespace pointfront
