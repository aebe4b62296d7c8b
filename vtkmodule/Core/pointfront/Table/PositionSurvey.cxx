#include "pointfront/Table/PositionSurvey.h"

#include "pointfront/Table/DecimalStep.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace pointfront
{
namespace
{
constexpr double mostSteps = 2147483647.0; // steps of an extent: 32 bits in a store
constexpr int mostDecimals = 15;

/// A decimal grid of so many places on each axis; nothing where the extent has too many steps, or
/// the coordinates have more digits than double precision.
std::optional<QuantisationGrid> decimalGrid(
  const std::array<int, 3>& decimals, const glm::dvec3& low, const glm::dvec3& high)
{
  QuantisationGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int places = decimals[static_cast<std::size_t>(axis)];
    const double step = std::pow(10.0, -places);
    const double reach = std::max(std::abs(low[axis]), std::abs(high[axis]));
    if (places > mostDecimals || !((high[axis] - low[axis]) / step < mostSteps) ||
      !(reach / step < mostStepsInDouble))
    {
      return std::nullopt;
    }
    // Written as a quotient: the nearest double to the decimal step.
    grid.scale[axis] = 1.0 / std::pow(10.0, places);
    grid.offset[axis] = reach / step < mostSteps ? 0.0 : std::round(0.5 * (low[axis] + high[axis]));
  }
  return grid;
}

/// The decimals of one axis. Doubles may be floats that a program widened: their decimal numbers
/// were rounded to float32.
class AxisSteps
{
public:
  void add(double value)
  {
    wide_.add(value);
    single_ = single_ && static_cast<double>(static_cast<float>(value)) == value;
    if (single_)
    {
      narrow_.add(value);
    }
  }
  void add(const AxisSteps& other)
  {
    wide_.add(other.wide_);
    narrow_.add(other.narrow_);
    single_ = single_ && other.single_;
  }
  std::optional<int> decimals() const
  {
    const std::optional<int> wide = wide_.decimals();
    return wide || !single_ ? wide : narrow_.decimals();
  }

private:
  DecimalStep wide_{ ScalarType::Float64 };
  DecimalStep narrow_{ ScalarType::Float32 }; ///< only true while `single_`
  bool single_ = true; ///< all numbers are those of float32
};

struct SeenPositions
{
  Bounds bounds;
  std::array<AxisSteps, 3> steps;

  void add(const glm::dvec3& position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(std::abs(position[axis]) <= farthestCoordinate)) // NaN, too
      {
        return;
      }
    }
    bounds.add(position);
    for (int axis = 0; axis < 3; ++axis)
    {
      steps[static_cast<std::size_t>(axis)].add(position[axis]);
    }
  }
  void add(const SeenPositions& other)
  {
    bounds.add(other.bounds);
    for (std::size_t axis = 0; axis < steps.size(); ++axis)
    {
      steps[axis].add(other.steps[axis]);
    }
  }
};
} // namespace

void PositionExtent::describe(SourceDescription& description) const
{
  description.declaredBounds = bounds;
  description.boundsLookedUp = true;
  description.grid = description.grid ? description.grid : grid;
}

PositionExtent extentOf(const std::array<AxisFacts, 3>& axes, const glm::dvec3& origin)
{
  PositionExtent extent;
  std::array<int, 3> decimals{};
  bool exact = origin == glm::round(origin);
  glm::dvec3 low(0.0);
  glm::dvec3 high(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const AxisFacts& facts = axes[static_cast<std::size_t>(axis)];
    low[axis] = origin[axis] + facts.low;
    high[axis] = origin[axis] + facts.high;
    exact = exact && facts.decimals;
    decimals[static_cast<std::size_t>(axis)] = facts.decimals.value_or(0);
  }
  extent.bounds.add(low);
  extent.bounds.add(high);
  if (exact)
  {
    std::array<int, 3> most{};
    most.fill(*std::max_element(decimals.begin(), decimals.end()));
    extent.grid = decimalGrid(most, low, high);
    extent.grid = extent.grid ? extent.grid : decimalGrid(decimals, low, high);
  }
  return extent;
}

Result<PositionExtent> surveyPositions(const PointSource& source, const SurveyOptions& options)
{
  SeenPositions survey;
  std::mutex mutex; // guards `survey`
  const auto visit = [&](std::uint64_t chunk) -> Result<void>
  {
    PointBatch batch;
    if (Result<void> done = source.read(chunk, batch); !done)
    {
      return done;
    }
    SeenPositions own;
    for (const glm::dvec3& position : batch.positions)
    {
      own.add(position);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    survey.add(own);
    return {};
  };
  if (Result<void> done = forEachChunk(source.chunkCount(), options, visit); !done)
  {
    return done.error();
  }
  if (survey.bounds.empty())
  {
    return PositionExtent{};
  }
  std::array<AxisFacts, 3> axes;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
  {
    const int a = static_cast<int>(axis);
    axes[axis] = { survey.bounds.low[a], survey.bounds.high[a], survey.steps[axis].decimals() };
  }
  return extentOf(axes, glm::dvec3(0.0));
}

} // namespace pointfront
