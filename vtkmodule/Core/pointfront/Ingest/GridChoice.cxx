#include "pointfront/Ingest/GridChoice.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Ingest/SourcesWithPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace pointfront
{
namespace
{
/// A quotient that near to an integer is one: scales and offsets in headers are decimal fractions.
constexpr double wholeTolerance = 1e-6;

bool whole(double v)
{
  return std::abs(v - std::round(v)) <= wholeTolerance;
}

std::string number(double v)
{
  return numberText(v, 9);
}

using SourceList = std::vector<PointSource*>;

bool usable(const QuantisationGrid& grid)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(grid.scale[axis] > 0.0) || !std::isfinite(grid.scale[axis]) ||
      !std::isfinite(grid.offset[axis]))
    {
      return false;
    }
  }
  return true;
}

/// True if every position of `fine` x `coarse` multiples lies on the grid.
bool liesOn(const QuantisationGrid& source, const QuantisationGrid& grid)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double ratio = source.scale[axis] / grid.scale[axis];
    const double steps = (source.offset[axis] - grid.offset[axis]) / grid.scale[axis];
    if (ratio < 1.0 - wholeTolerance || !whole(ratio) || !whole(steps))
    {
      return false;
    }
  }
  return true;
}

Bounds declaredBounds(const SourceList& sources)
{
  Bounds bounds;
  for (PointSource* const source : sources)
  {
    const Bounds& declared = source->description().declaredBounds;
    const glm::dvec3 reach = glm::max(glm::abs(declared.low), glm::abs(declared.high));
    if (!declared.empty() && std::max({ reach.x, reach.y, reach.z }) <= farthestCoordinate)
    {
      bounds.add(declared);
    }
  }
  return bounds;
}

/// Offsets are whole units near the data, and whole steps where those are larger: a reader of the
/// file can tell what they are, and coordinates on whole steps are not rounded.
glm::dvec3 roundOffset(const Bounds& bounds, const glm::dvec3& scale)
{
  const glm::dvec3 unit = glm::max(scale, glm::dvec3(1.0));
  return bounds.empty() ? glm::dvec3(0.0) : unit * glm::round(bounds.centre() / unit);
}

using AxisValues = std::array<std::vector<double>, 3>;

/// Coordinates of some chunks, sorted on each axis; of sources without a grid.
AxisValues sampledValues(const SourceList& sources)
{
  constexpr std::uint64_t mostChunks = 8;
  AxisValues values;
  for (std::size_t s = 0; s < sources.size(); s += 1 + sources.size() / mostChunks)
  {
    const std::uint64_t chunks = sources[s]->chunkCount();
    const std::uint64_t visits =
      std::min(chunks, std::max<std::uint64_t>(1, mostChunks / sources.size()));
    for (std::uint64_t visit = 0; visit < visits; ++visit)
    {
      PointBatch batch;
      if (!sources[s]->read(visit * chunks / visits, batch))
      {
        continue; // the build will say why
      }
      for (const glm::dvec3& p : batch.positions)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double value = p[static_cast<int>(axis)];
          if (std::abs(value) <= farthestCoordinate)
          {
            values[axis].push_back(value);
          }
        }
      }
    }
  }
  for (std::vector<double>& axis : values)
  {
    std::sort(axis.begin(), axis.end());
  }
  return values;
}

/// The length that points occupy on one axis: the extent of nine tenths without the widest gaps
/// between two neighbours. Two clouds that lie far apart occupy what each has, not their distance.
double occupied(const std::vector<double>& sorted)
{
  constexpr std::size_t mostGaps = 8;
  const std::size_t twentieth = sorted.size() / 20;
  std::vector<double> gaps;
  double sum = 0.0;
  for (std::size_t i = twentieth + 1; i + twentieth < sorted.size(); ++i)
  {
    gaps.push_back(sorted[i] - sorted[i - 1]);
    sum += gaps.back();
  }
  const std::size_t left = std::min(mostGaps, twentieth); // few points: every gap is a wide one
  std::partial_sort(
    gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(left), gaps.end(), std::greater<>());
  if (left == 0)
  {
    return sum;
  }
  return std::accumulate(gaps.begin() + static_cast<std::ptrdiff_t>(left), gaps.end(), 0.0);
}

/// The size that most points occupy on each axis, world units; nothing if no point could be read.
std::optional<glm::dvec3> bulkSize(const SourceList& sources)
{
  const AxisValues values = sampledValues(sources);
  glm::dvec3 size(0.0);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (values[axis].empty())
    {
      return std::nullopt;
    }
    size[static_cast<int>(axis)] = occupied(values[axis]);
  }
  return size;
}

/// The finest step of a power of ten that double precision tells apart at `reach` from the origin.
double finestStep(double reach)
{
  return reach > 0.0 ? std::pow(10.0, std::ceil(std::log10(reach / mostStepsInDouble))) : 0.0;
}

double farthestOf(const Bounds& bounds)
{
  const glm::dvec3 reach = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max({ reach.x, reach.y, reach.z });
}

double millionth(double extent)
{
  return std::pow(10.0, std::floor(std::log10(extent)) - 6.0);
}

double largest(const glm::dvec3& size)
{
  return std::max({ size.x, size.y, size.z });
}

/// Steps for an extent that is far larger than what most points have; see chooseGrid().
Result<double> stepAmongOutliers(double extent, double bulk)
{
  constexpr double mostSteps = 2.0e9; // 32 bits, less what the tree's alignment takes
  constexpr double leastSteps = 1.0e4; // steps of the extent of most points
  const double step = std::pow(10.0, std::ceil(std::log10(extent / mostSteps)));
  if (bulk < leastSteps * step)
  {
    return makeError(Error::Kind::BadArgument,
      "most points lie within " + number(bulk) + " units, some " + number(extent) +
        " units apart: more than 32 bits of steps that tell the former from each other. Leave out "
        "the points that lie far away, or give the precision to round all of them to (" +
        number(step) + " fits)");
  }
  return step;
}

Result<GridChoice> defaultGrid(const SourceList& sources)
{
  constexpr double outlying = 1000.0; // times what most points have
  const Bounds bounds = declaredBounds(sources);
  GridChoice choice;
  const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.size();
  const double extent = largest(size);
  if (extent > 0.0)
  {
    const double bulk = largest(bulkSize(sources).value_or(size));
    const Result<double> step = bulk > 0.0 && extent > outlying * bulk
      ? stepAmongOutliers(extent, bulk)
      : Result<double>(millionth(extent));
    if (!step)
    {
      return step.error();
    }
    choice.grid.scale = glm::dvec3(*step);
    const double plane = std::max(size.x, size.y);
    if (plane > 0.0 && size.z > plane)
    {
      choice.grid.scale.x = choice.grid.scale.y = std::min(*step, millionth(plane));
    }
  }
  if (!bounds.empty())
  {
    choice.grid.scale = glm::max(choice.grid.scale, glm::dvec3(finestStep(farthestOf(bounds))));
  }
  choice.grid.offset = roundOffset(bounds, choice.grid.scale);
  const glm::dvec3& s = choice.grid.scale;
  choice.warnings.push_back(
    "The input has floating point coordinates; they are rounded to steps of " +
    (s.x == s.z ? number(s.x) : number(s.x) + ", " + number(s.y) + ", " + number(s.z)) +
    " units. Give a precision to choose another step.");
  return choice;
}

/// The finest scale of all sources, with the offset of the first that has it.
std::optional<QuantisationGrid> finestGrid(const SourceList& sources)
{
  std::optional<QuantisationGrid> finest;
  for (PointSource* const source : sources)
  {
    const auto& grid = source->description().grid;
    if (!grid || !usable(*grid))
    {
      continue;
    }
    if (!finest)
    {
      finest = grid;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if (grid->scale[axis] < finest->scale[axis] * (1.0 - wholeTolerance))
      {
        finest->scale[axis] = grid->scale[axis];
        finest->offset[axis] = grid->offset[axis];
      }
    }
  }
  return finest;
}

void warnOfRounding(const SourceList& sources, GridChoice& choice)
{
  const glm::dvec3& s = choice.grid.scale;
  for (PointSource* const source : sources)
  {
    const SourceDescription& description = source->description();
    const bool lossless =
      description.grid && usable(*description.grid) && liesOn(*description.grid, choice.grid);
    if (lossless || description.pointCount == 0) // none of them has points
    {
      continue;
    }
    choice.warnings.push_back("Coordinates of '" + description.path +
      "' do not lie on the store's grid and are rounded, by at most " + number(0.5 * s.x) + ", " +
      number(0.5 * s.y) + ", " + number(0.5 * s.z) + " units in x, y, z.");
  }
}
} // namespace

namespace
{
Result<GridChoice> chosenGrid(const SourceList& sources, const std::optional<double>& precision)
{
  const std::optional<QuantisationGrid> finest = finestGrid(sources);
  if (!precision && !finest)
  {
    return defaultGrid(sources);
  }
  GridChoice choice;
  choice.grid = finest ? *finest : QuantisationGrid{};
  if (precision)
  {
    choice.grid.scale = glm::dvec3(*precision);
  }
  if (!finest)
  {
    choice.grid.offset = roundOffset(declaredBounds(sources), choice.grid.scale);
  }
  warnOfRounding(sources, choice);
  return choice;
}

/// Where the declared extent lies on the grid.
void placeExtent(const Bounds& bounds, GridChoice& choice)
{
  constexpr double most = 4503599627370496.0; // 2^52
  if (bounds.empty())
  {
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto steps = [&](double world)
    {
      const double at = (world - choice.grid.offset[axis]) / choice.grid.scale[axis];
      return static_cast<std::int64_t>(std::clamp(at, -most, most));
    };
    choice.low[axis] = steps(bounds.low[axis]);
    choice.high[axis] = steps(bounds.high[axis]);
  }
}
} // namespace

Result<GridChoice> givenGrid(
  const std::vector<std::unique_ptr<PointSource>>& sources, const QuantisationGrid& grid)
{
  GridChoice choice;
  choice.grid = grid;
  // A tile's sources without points stand for some of other tiles: all tell of one extent.
  placeExtent(declaredBounds(allSources(sources)), choice);
  return choice;
}

Result<GridChoice> chooseGrid(
  const std::vector<std::unique_ptr<PointSource>>& given, const std::optional<double>& precision)
{
  const SourceList sources = sourcesWithPoints(given);
  constexpr double coarsest = 1e12;
  if (precision && (!(*precision > 0.0) || !(*precision <= coarsest)))
  {
    return makeError(Error::Kind::BadArgument,
      "a precision of " + number(*precision) +
        " is not a step of coordinates; give a positive number, 1e12 at most");
  }
  const Bounds bounds = declaredBounds(sources);
  const double reach = bounds.empty() ? 0.0 : farthestOf(bounds);
  if (precision && *precision < reach / mostStepsInDouble)
  {
    return makeError(Error::Kind::BadArgument,
      "a precision of " + number(*precision) + " is finer than double precision tells apart " +
        number(reach) + " units from the origin; " + number(finestStep(reach)) + " fits");
  }
  Result<GridChoice> choice = chosenGrid(sources, precision);
  if (!choice)
  {
    return choice;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const double scale = choice->grid.scale[axis];
    const double offset = choice->grid.offset[axis];
    if (scale > coarsest || !(std::abs(offset) <= farthestCoordinate))
    {
      return makeError(Error::Kind::BadArgument,
        "coordinates in steps of " + number(scale) + " units from " + number(offset) +
          " are no positions; the inputs' scales, offsets or "
          "bounds are wrong");
    }
  }
  placeExtent(bounds, *choice);
  return choice;
}

} // namespace pointfront
