#include "pointfront/Build/RecordPacker.h"

#include "pointfront/Build/PointIngest.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
/// Doubles hold every integer up to here; a coordinate beyond it has lost its last step already.
constexpr double largestSteps = 9007199254740992.0; // 2^53

/// Columns are scattered into the records of a tile while these are in the nearest cache.
constexpr std::size_t tilePoints = 512;

/// std::llround() for |v| < 2^53, as QuantisationGrid::toGrid() does it, without the call: the
/// fraction is exact, and exact halves go away from zero.
std::int64_t rounded(double v)
{
  const auto whole = static_cast<std::int64_t>(v);
  const double fraction = v - static_cast<double>(whole);
  return whole + (fraction >= 0.5 ? 1 : 0) - (fraction <= -0.5 ? 1 : 0);
}

std::optional<Rejection> fault(const glm::dvec3& world, const glm::dvec3& steps)
{
  const double reach = std::max({std::abs(steps.x), std::abs(steps.y), std::abs(steps.z)});
  if (reach <= largestSteps && !std::isnan(steps.x + steps.y + steps.z))
  {
    return std::nullopt;
  }
  if (std::isnan(world.x) || std::isnan(world.y) || std::isnan(world.z))
  {
    return Rejection::NotANumber;
  }
  return std::isinf(world.x) || std::isinf(world.y) || std::isinf(world.z) ? Rejection::Infinite
                                                                           : Rejection::OutsideGrid;
}

template <std::size_t Bytes>
void scatter(const std::byte* in, std::byte* out, std::size_t stride, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memcpy(out + i * stride, in + i * Bytes, Bytes);
  }
}

void scatter(
  const std::byte* in, std::size_t bytes, std::byte* out, std::size_t stride, std::size_t count)
{
  switch (bytes)
  {
  case 1:
    return scatter<1>(in, out, stride, count);
  case 2:
    return scatter<2>(in, out, stride, count);
  case 3:
    return scatter<3>(in, out, stride, count);
  case 4:
    return scatter<4>(in, out, stride, count);
  case 6:
    return scatter<6>(in, out, stride, count);
  case 8:
    return scatter<8>(in, out, stride, count);
  default:
    for (std::size_t i = 0; i < count; ++i)
    {
      std::memcpy(out + i * stride, in + i * bytes, bytes);
    }
  }
}

void zero(std::size_t bytes, std::byte* out, std::size_t stride, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memset(out + i * stride, 0, bytes);
  }
}

std::uint16_t largest(const std::byte* values, std::size_t count)
{
  std::uint16_t most = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    std::uint16_t value;
    std::memcpy(&value, values + 2 * i, sizeof(value));
    most = std::max(most, value);
  }
  return most;
}
} // namespace

const char* nameOf(Rejection reason)
{
  switch (reason)
  {
  case Rejection::NotANumber:
    return "not a number";
  case Rejection::Infinite:
    return "infinite";
  case Rejection::OutsideGrid:
  case Rejection::Count:
    break;
  }
  return "outside the grid's range";
}

RecordPacker::RecordPacker(const CommonSchema& schema, const TreeSpace& space, unsigned cellShift,
  std::optional<std::size_t> classOffset)
    : schema_(schema), space_(space), layout_(schema.schema),
      colour_(wideColourColumn(schema.schema)), classOffset_(classOffset), counts_(cellShift)
{
}

void RecordPacker::pack(const AttributeSchema& sourceSchema, std::size_t source, PointBatch& batch)
{
  records_.resize(batch.size() * layout_.bytes());
  largestColour_ = 0;
  count_ = 0;
  for (std::size_t begin = 0; begin < batch.size(); begin += tilePoints)
  {
    const std::size_t firstKept = count_;
    quantise(batch, sourceSchema, begin, std::min(batch.size(), begin + tilePoints));
    for (std::size_t c = 0; c < schema_.schema.size(); ++c)
    {
      packColumn(sourceSchema, schema_.mappings[source][c], c, batch, firstKept);
    }
  }
  countCells();
}

void RecordPacker::quantise(
  PointBatch& batch, const AttributeSchema& sourceSchema, std::size_t begin, std::size_t end)
{
  const QuantisationGrid& grid = space_.grid;
  for (std::size_t i = begin; i < end; ++i)
  {
    const glm::dvec3& world = batch.positions[i];
    const glm::dvec3 steps = (world - grid.offset) / grid.scale;
    if (const auto reason = fault(world, steps))
    {
      ++rejected_[std::size_t(*reason)];
      continue;
    }
    const GridPosition g{rounded(steps.x), rounded(steps.y), rounded(steps.z)};
    low_ = glm::min(low_, g);
    high_ = glm::max(high_, g);
    setPosition(records_.data() + count_ * layout_.bytes(), space_.absoluteSteps(g));
    if (count_ != i)
    {
      for (std::size_t c = 0; c < sourceSchema.size(); ++c)
      {
        const std::size_t bytes = sourceSchema[c].bytes();
        std::byte* column = batch.columns[c].data();
        std::memcpy(column + count_ * bytes, column + i * bytes, bytes);
      }
    }
    ++count_;
  }
}

void RecordPacker::packColumn(const AttributeSchema& sourceSchema, const ColumnMapping& mapping,
  std::size_t column, const PointBatch& batch, std::size_t begin)
{
  const Attribute& attribute = schema_.schema[column];
  const std::size_t count = count_ - begin;
  std::byte* out = records_.data() + begin * layout_.bytes() + layout_.offset(column);
  if (!mapping.column)
  {
    zero(attribute.bytes(), out, layout_.bytes(), count);
    return;
  }
  const Attribute& own = sourceSchema[*mapping.column];
  const std::byte* values = batch.columns[*mapping.column].data() + begin * own.bytes();
  if (mapping.converted)
  {
    converted_.resize(count * attribute.bytes());
    convertColumn(own, values, attribute, converted_.data(), count);
    values = converted_.data();
  }
  if (colour_ == column)
  {
    largestColour_ = std::max(largestColour_, largest(values, count * attribute.components));
  }
  scatter(values, attribute.bytes(), out, layout_.bytes(), count);
}

void RecordPacker::countCells()
{
  const RecordView view{records_.data(), layout_.bytes()};
  const unsigned shift = counts_.shift(); // counts_ may coarsen meanwhile
  for (std::size_t i = 0; i < count_; ++i)
  {
    const TreePosition p = view.position(i);
    const TreePosition cell{p.x >> shift, p.y >> shift, p.z >> shift};
    const auto objectClass =
      classOffset_ ? std::to_integer<std::uint8_t>(view.record(i)[*classOffset_]) : std::uint8_t(0);
    Run& run = runs_[objectClass];
    if (run.cell != cell)
    {
      endRun(objectClass, shift);
    }
    run.cell = cell;
    ++run.count;
  }
  for (unsigned c = 0; c < runs_.size(); ++c)
  {
    endRun(static_cast<std::uint8_t>(c), shift);
  }
}

void RecordPacker::endRun(std::uint8_t objectClass, unsigned shift)
{
  Run& run = runs_[objectClass];
  if (run.count > 0)
  {
    counts_.add(
      objectClass, {run.cell.x << shift, run.cell.y << shift, run.cell.z << shift}, run.count);
    run.count = 0;
  }
}

} // namespace pointfront
