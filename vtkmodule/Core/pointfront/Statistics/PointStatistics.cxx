#include "pointfront/Statistics/PointStatistics.h"

#include "pointfront/Statistics/BatchValues.h"
#include "pointfront/Statistics/GroundCells.h"
#include "pointfront/Statistics/PointGroups.h"
#include "pointfront/Statistics/ValueSpan.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace pointfront
{
namespace
{
/// A group for each class that occurs.
template <typename Group>
using GroupTable = std::array<std::unique_ptr<Group>, PointGroups::count>;

template <typename Group>
void addGroups(GroupTable<Group>& to, const GroupTable<Group>& from)
{
  for (std::size_t g = 0; g < to.size(); ++g)
  {
    if (from[g] && to[g])
    {
      to[g]->add(*from[g]);
    }
    else if (from[g])
    {
      to[g] = std::make_unique<Group>(*from[g]);
    }
  }
}

template <typename Group>
Group& groupOf(GroupTable<Group>& table, std::int16_t group, std::size_t components)
{
  std::unique_ptr<Group>& entry = table[static_cast<std::size_t>(group)];
  if (!entry)
  {
    entry = std::make_unique<Group>(components);
  }
  return *entry;
}

template <typename T>
void addEach(std::vector<T>& to, const std::vector<T>& from)
{
  for (std::size_t i = 0; i < to.size(); ++i)
  {
    to[i].add(from[i]);
  }
}

/// A group's ranges, found in the first reading.
struct RangeGroup
{
  explicit RangeGroup(std::size_t components)
    : ranges(components)
  {
  }
  void add(const RangeGroup& other)
  {
    points += other.points;
    bounds.add(other.bounds);
    addEach(ranges, other.ranges);
  }
  std::uint64_t points = 0;
  Bounds bounds;
  std::vector<ValueSpan> ranges;
};

/// A group's sums, found in the second reading. Shapes: bins[component][bin].
struct SumGroup
{
  explicit SumGroup(std::size_t components)
    : sums(components)
    , bins(components)
  {
  }
  void add(const SumGroup& other)
  {
    addEach(sums, other.sums);
    for (std::size_t c = 0; c < bins.size(); ++c)
    {
      bins[c].resize(std::max(bins[c].size(), other.bins[c].size()));
      for (std::size_t b = 0; b < other.bins[c].size(); ++b)
      {
        bins[c][b] += other.bins[c][b];
      }
    }
  }
  std::vector<StepSums> sums;
  std::vector<std::vector<std::uint64_t>> bins;
};

/// One thread's.
struct RangeTally
{
  std::uint64_t read = 0;
  RejectionCounts rejected{};
  GroupTable<RangeGroup> groups;
  std::vector<std::int16_t> groupOfPoint; ///< group of each point of the batch at hand

  void add(const RangeTally& other)
  {
    read += other.read;
    for (std::size_t r = 0; r < rejected.size(); ++r)
    {
      rejected[r] += other.rejected[r];
    }
    addGroups(groups, other.groups);
  }
};

struct SumTally
{
  RejectionCounts rejected{}; ///< as the first reading found them
  GroupTable<SumGroup> groups;
  std::vector<std::int16_t> groupOfPoint; ///< group of each point of the batch at hand
};

std::vector<ComponentName> namesOf(const AttributeSchema& schema)
{
  std::vector<ComponentName> names{ { "x" }, { "y" }, { "z" } };
  for (const Attribute& attribute : schema)
  {
    for (unsigned k = 0; k < attribute.components; ++k)
    {
      names.push_back({ attribute.name, k, attribute.components });
    }
  }
  return names;
}

std::vector<ValueKind> kindsOf(const AttributeSchema& schema)
{
  std::vector<ValueKind> kinds(3, ValueKind::Real);
  for (const Attribute& attribute : schema)
  {
    kinds.insert(kinds.end(), attribute.components, valueKindOf(attribute));
  }
  return kinds;
}

void countBatch(
  const PointBatch& batch, const PointGroups& groups, std::size_t components, RangeTally& tally)
{
  tally.read += batch.size();
  groups.assign(batch, tally.groupOfPoint, tally.rejected);
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    if (tally.groupOfPoint[i] != PointGroups::none)
    {
      RangeGroup& group = groupOf(tally.groups, tally.groupOfPoint[i], components);
      ++group.points;
      group.bounds.add(batch.positions[i]);
    }
  }
}

void rangeBatch(const AttributeSchema& schema, const PointBatch& batch, RangeTally& tally)
{
  visitComponents(schema, batch,
    [&](std::size_t component, const auto& valueOf)
    {
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        const std::int16_t group = tally.groupOfPoint[i];
        if (group == PointGroups::none)
        {
          continue;
        }
        ValueSpan& range = tally.groups[static_cast<std::size_t>(group)]->ranges[component];
        const FoundValue found = valueOf(i);
        if (found.kind == FoundValue::Kind::Finite)
        {
          range.add(found.key);
        }
        else
        {
          ++(found.kind == FoundValue::Kind::NotANumber ? range.notANumber : range.infinite);
        }
      }
    });
}

void sumBatch(const AttributeSchema& schema, const PointBatch& batch,
  const std::vector<ValueSteps>& steps, SumTally& tally)
{
  visitComponents(schema, batch,
    [&](std::size_t component, const auto& valueOf)
    {
      const ValueSteps& own = steps[component];
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        const std::int16_t number = tally.groupOfPoint[i];
        if (number == PointGroups::none)
        {
          continue;
        }
        const FoundValue found = valueOf(i);
        if (found.kind == FoundValue::Kind::Finite)
        {
          SumGroup& group = groupOf(tally.groups, number, steps.size());
          group.bins[component].resize(own.bins());
          group.sums[component].add(own.step(found.key));
          ++group.bins[component][own.bin(found.key)];
        }
      }
    });
}

Result<RangeTally> rangesOf(const PointSource& source, const ScanOptions& options, bool values)
{
  const AttributeSchema& schema = source.description().schema;
  const PointGroups groups(schema);
  const std::size_t components = values ? namesOf(schema).size() : 0;
  std::vector<RangeTally> tallies(crewOf(options).threads());
  const auto work = [&](const PointBatch& batch, unsigned thread)
  {
    countBatch(batch, groups, components, tallies[thread]);
    if (values)
    {
      rangeBatch(schema, batch, tallies[thread]);
    }
  };
  if (Result<void> done = scanBatches(source, options, work); !done)
  {
    return done.error();
  }
  for (std::size_t t = 1; t < tallies.size(); ++t)
  {
    tallies[0].add(tallies[t]);
  }
  return std::move(tallies[0]);
}

Result<GroupTable<SumGroup>> sumsOf(const PointSource& source, const ScanOptions& options,
  const std::vector<ValueSteps>& steps, GroundCells& ground)
{
  const AttributeSchema& schema = source.description().schema;
  const PointGroups groups(schema);
  std::vector<SumTally> tallies(crewOf(options).threads());
  const auto work = [&](const PointBatch& batch, unsigned thread)
  {
    SumTally& tally = tallies[thread];
    groups.assign(batch, tally.groupOfPoint, tally.rejected);
    sumBatch(schema, batch, steps, tally);
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      if (tally.groupOfPoint[i] != PointGroups::none)
      {
        ground.add(batch.positions[i]);
      }
    }
  };
  if (Result<void> done = scanBatches(source, options, work); !done)
  {
    return done.error();
  }
  for (std::size_t t = 1; t < tallies.size(); ++t)
  {
    addGroups(tallies[0].groups, tallies[t].groups);
  }
  return std::move(tallies[0].groups);
}

RangeGroup wholeOf(const GroupTable<RangeGroup>& groups, std::size_t components)
{
  RangeGroup whole(components);
  for (const std::unique_ptr<RangeGroup>& group : groups)
  {
    if (group)
    {
      whole.add(*group);
    }
  }
  return whole;
}

PointCount countOf(const RangeTally& tally, const RangeGroup& whole)
{
  PointCount count;
  count.read = tally.read;
  count.points = whole.points;
  count.bounds = whole.bounds;
  for (std::size_t r = 0; r < tally.rejected.size(); ++r)
  {
    if (tally.rejected[r] > 0)
    {
      count.rejected[nameOf(Rejection(r))] = tally.rejected[r];
    }
  }
  return count;
}

GroupStatistics statisticsOf(const RangeGroup& found, const SumGroup& summed,
  const std::vector<ValueKind>& kinds, const std::vector<ValueSteps>& steps)
{
  GroupStatistics group;
  group.points = found.points;
  group.bounds = found.bounds;
  for (std::size_t c = 0; c < kinds.size(); ++c)
  {
    const ValueSpan& range = found.ranges[c];
    ComponentStatistics component;
    component.count = range.count;
    component.notANumber = range.notANumber;
    component.infinite = range.infinite;
    if (range.count > 0)
    {
      component.low = valueKey::value(kinds[c], range.low);
      component.high = valueKey::value(kinds[c], range.high);
    }
    component.moments = steps[c].moments(summed.sums[c]);
    component.histogram = summed.bins[c];
    component.histogram.resize(steps[c].bins());
    group.components.push_back(std::move(component));
  }
  return group;
}
} // namespace

std::optional<double> PointStatistics::density() const
{
  if (occupiedCells == 0)
  {
    return std::nullopt;
  }
  return static_cast<double>(all.points) /
    (static_cast<double>(occupiedCells) * cellSize * cellSize);
}

Result<PointCount> countPoints(const PointSource& source, const ScanOptions& options)
{
  const Result<RangeTally> tally = rangesOf(source, options, false);
  if (!tally)
  {
    return tally.error();
  }
  return countOf(*tally, wholeOf(tally->groups, 0));
}

Result<PointStatistics> gatherStatistics(
  const PointSource& source, const StatisticsOptions& options)
{
  const Result<RangeTally> ranges = rangesOf(source, options.scan, true);
  if (!ranges)
  {
    return ranges.error();
  }
  const AttributeSchema& schema = source.description().schema;
  const std::vector<ValueKind> kinds = kindsOf(schema);
  const RangeGroup whole = wholeOf(ranges->groups, kinds.size());
  PointStatistics statistics;
  statistics.counted = countOf(*ranges, whole);
  statistics.names = namesOf(schema);
  std::vector<ValueSteps> steps;
  for (std::size_t c = 0; c < kinds.size(); ++c)
  {
    const ValueSpan& range = whole.ranges[c];
    steps.emplace_back(kinds[c], range, options.bins);
    const auto low = valueKey::value(kinds[c], range.low);
    statistics.bins.push_back(
      { range.count > 0 ? std::optional<ExactValue>(low) : std::nullopt, steps[c].binWidth() });
  }
  GroundCells ground(whole.bounds, whole.points);
  const Result<GroupTable<SumGroup>> sums = sumsOf(source, options.scan, steps, ground);
  if (!sums)
  {
    return sums.error();
  }
  SumGroup all(kinds.size());
  for (std::size_t g = 0; g < PointGroups::count; ++g)
  {
    const auto& found = ranges->groups[g];
    const auto& summed = (*sums)[g];
    if (!found || !summed)
    {
      continue;
    }
    all.add(*summed);
    if (PointGroups(schema).classified())
    {
      statistics.classes[static_cast<std::uint8_t>(g)] =
        statisticsOf(*found, *summed, kinds, steps);
    }
  }
  statistics.all = statisticsOf(whole, all, kinds, steps);
  statistics.cellSize = ground.cellSize();
  statistics.occupiedCells = ground.occupied();
  return statistics;
}

} // namespace pointfront
