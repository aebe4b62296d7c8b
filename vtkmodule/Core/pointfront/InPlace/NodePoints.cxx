#include "pointfront/InPlace/NodePoints.h"

#include "pointfront/InPlace/RunList.h"
#include "pointfront/InPlace/SampleStream.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
/// Values with at most this many unwanted bytes between them are fetched by one read: the system
/// reads whole pages, and ahead.
constexpr std::uint64_t mergeGapBytes = 4 * 4096;
constexpr std::uint64_t readAtOnce = std::uint64_t(1) << 20;
} // namespace

std::optional<std::vector<std::uint64_t>> pointsOfList(const InPlaceTable& table, NodeIndex node,
  const std::vector<std::byte>& list, std::uint64_t count)
{
  const Node& row = table.nodes[node];
  const SampleStream own{ table.rows[node].logStep };
  const std::vector<std::uint8_t> above =
    row.leaf() ? stepsAbove(table, node) : std::vector<std::uint8_t>();
  std::vector<std::uint64_t> points;
  points.reserve(row.pointCount);
  RunListReader runs(list.data(), list.size());
  bool sound = true;
  for (Run run; sound && runs.next(run);)
  {
    sound = run.first + run.count <= (row.leaf() ? count : (count >> own.logStep) + 1);
    for (std::uint64_t i = run.first; sound && i < run.first + run.count; ++i)
    {
      const std::uint64_t point = row.leaf() ? i : own.sample(i);
      const bool heldAbove = std::any_of(above.begin(), above.end(),
        [point](std::uint8_t step) { return SampleStream{ step }.contains(point); });
      if (!heldAbove)
      {
        sound = point < count && points.size() < row.pointCount;
        points.push_back(point);
      }
    }
  }
  if (!sound || !runs.sound() || points.size() != row.pointCount)
  {
    return std::nullopt;
  }
  return points;
}

Result<RawBytes> gatherValues(const ValuesInFile& values, const std::vector<std::uint64_t>& numbers)
{
  RawBytes gathered(numbers.size() * values.stride);
  RawBytes window(static_cast<std::size_t>(readAtOnce) + values.stride);
  const auto offset = [&](std::size_t i) { return values.offset + numbers[i] * values.stride; };
  for (std::size_t first = 0; first < numbers.size();)
  {
    std::size_t end = first + 1;
    while (end < numbers.size() && offset(end) - offset(end - 1) <= mergeGapBytes &&
      offset(end) - offset(first) <= readAtOnce)
    {
      ++end;
    }
    const std::uint64_t size = offset(end - 1) + values.stride - offset(first);
    Result<void> done =
      values.read(offset(first), window.data.get(), static_cast<std::size_t>(size));
    if (!done)
    {
      return done.error();
    }
    for (std::size_t i = first; i < end; ++i)
    {
      std::memcpy(gathered.data.get() + i * values.stride,
        window.data.get() + (offset(i) - offset(first)), values.stride);
    }
    first = end;
  }
  return gathered;
}

} // namespace pointfront
