#include "pointfront/Ingest/RecordPacker.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
/// Doubles hold every integer up to here; a coordinate beyond it has lost its last step already.
constexpr double largestSteps = 9007199254740992.0; // 2^53

/// Columns are scattered into the records of a tile while these are in the nearest cache.
constexpr std::size_t scatteredPoints = 512;

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
  const double reach = std::max({ std::abs(steps.x), std::abs(steps.y), std::abs(steps.z) });
  const double far = std::max({ std::abs(world.x), std::abs(world.y), std::abs(world.z) });
  if (reach <= largestSteps && far <= farthestCoordinate &&
    !std::isnan(steps.x + steps.y + steps.z))
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

/// The lower bytes of 16-bit values; false when one is above 255.
bool lowBytes(const std::byte* values, std::size_t components, std::byte* out, std::size_t stride,
  std::size_t count)
{
  std::uint32_t any = 0;
  for (std::size_t i = 0; i < count; ++i, out += stride)
  {
    for (std::size_t k = 0; k < components; ++k, values += 2)
    {
      out[k] = values[0]; // records are of this machine: little-endian
      any |= std::to_integer<std::uint32_t>(values[1]);
    }
  }
  return any == 0;
}

/// Smallest and largest steps on each axis. Lanes of four points: a few vectors.
void addSteps(const glm::ivec3* steps, std::size_t count, GridPosition& low, GridPosition& high)
{
  constexpr std::size_t lanes = 12;
  std::array<std::int32_t, lanes> lowest;
  std::array<std::int32_t, lanes> highest;
  lowest.fill(INT32_MAX);
  highest.fill(INT32_MIN);
  const std::int32_t* values = &steps->x;
  const auto see = [&](std::size_t known)
  {
    for (std::size_t lane = 0; lane < known; ++lane)
    {
      lowest[lane] = values[lane] < lowest[lane] ? values[lane] : lowest[lane];
      highest[lane] = values[lane] > highest[lane] ? values[lane] : highest[lane];
    }
  };
  for (; count >= lanes / 3; count -= lanes / 3, values += lanes)
  {
    see(lanes);
  }
  see(3 * count);
  for (std::size_t lane = 0; lane < lanes; ++lane)
  {
    const auto axis = static_cast<int>(lane % 3);
    low[axis] = std::min<std::int64_t>(low[axis], lowest[lane]);
    high[axis] = std::max<std::int64_t>(high[axis], highest[lane]);
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

RecordPacker::RecordPacker(const CommonSchema& common, const RecordColumns& columns,
  const TreeSpace& space, unsigned cellShift, std::optional<std::size_t> classOffset)
  : common_(common)
  , columns_(columns)
  , space_(space)
  , layout_(columns.schema())
  , colour_(wideColourColumn(common.schema))
  , wrong_(common.schema.size(), false)
  , classOffset_(classOffset)
  , cells_(cellShift)
  , counts_(cellShift)
{
}

void RecordPacker::begin(std::size_t points)
{
  count_ = 0;
  largestColour_ = 0;
  records_.resize(std::max(records_.size(), points * layout_.bytes()));
  cells_.begin(points);
}

bool RecordPacker::append(
  const AttributeSchema& sourceSchema, std::size_t source, PointBatch& batch)
{
  assert((count_ + batch.size()) * layout_.bytes() <= records_.size());
  bool right = true;
  std::size_t kept = 0; // number kept of the batch, at its beginning
  for (std::size_t begin = 0; begin < batch.size(); begin += scatteredPoints)
  {
    const std::size_t end = std::min(batch.size(), begin + scatteredPoints);
    const std::size_t from = kept;
    const std::size_t to = count_;
    if (batch.steps.empty())
    {
      kept = quantise(batch, sourceSchema, begin, end, kept);
    }
    else
    {
      takeSteps(batch, begin, end);
      kept = end;
    }
    for (std::size_t c = 0; c < common_.schema.size(); ++c)
    {
      const ColumnMapping& mapping = common_.mappings[source][c];
      right &= packColumn(sourceSchema, mapping, c, batch, from, to, count_ - to);
    }
    addCells(to);
  }
  return right;
}

void RecordPacker::takeSteps(const PointBatch& batch, std::size_t begin, std::size_t end)
{
  std::byte* record = records_.data() + count_ * layout_.bytes();
  addSteps(batch.steps.data() + begin, end - begin, low_, high_);
  const std::array<unsigned, 3> shift = space_.shift;
  for (std::size_t i = begin; i < end; ++i, record += layout_.bytes())
  {
    // The low 32 bits, as TreeSpace::absoluteSteps().
    const glm::u32vec3 steps(batch.steps[i]);
    setPosition(record, { steps.x << shift[0], steps.y << shift[1], steps.z << shift[2] });
  }
  count_ += end - begin;
}

std::size_t RecordPacker::quantise(PointBatch& batch, const AttributeSchema& sourceSchema,
  std::size_t begin, std::size_t end, std::size_t kept)
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
    const GridPosition g{ rounded(steps.x), rounded(steps.y), rounded(steps.z) };
    low_ = glm::min(low_, g);
    high_ = glm::max(high_, g);
    setPosition(records_.data() + count_ * layout_.bytes(), space_.absoluteSteps(g));
    if (kept != i)
    {
      for (std::size_t c = 0; c < sourceSchema.size(); ++c)
      {
        const std::size_t bytes = sourceSchema[c].bytes();
        std::byte* column = batch.columns[c].data();
        std::memcpy(column + kept * bytes, column + i * bytes, bytes);
      }
    }
    ++kept;
    ++count_;
  }
  return kept;
}

bool RecordPacker::packColumn(const AttributeSchema& sourceSchema, const ColumnMapping& mapping,
  std::size_t column, const PointBatch& batch, std::size_t from, std::size_t to, std::size_t count)
{
  const Attribute& attribute = common_.schema[column];
  const std::size_t bytes = attribute.bytes();
  const auto& constant = columns_.constant(column);
  const std::byte* values = nullptr;
  if (mapping.column)
  {
    const Attribute& own = sourceSchema[*mapping.column];
    values = batch.columns[*mapping.column].data() + from * own.bytes();
    if (mapping.converted)
    {
      converted_.resize(count * bytes);
      convertColumn(own, values, attribute, converted_.data(), count);
      values = converted_.data();
    }
  }
  if (constant)
  {
    const ConstantValue zeros(values ? 0 : bytes, std::byte(0));
    const bool right =
      allAre(values ? values : zeros.data(), bytes, values ? count : 1u, constant->data());
    wrong_[column] = wrong_[column] || !right;
    return right;
  }
  const std::size_t place = *columns_.place(column);
  std::byte* out = records_.data() + to * layout_.bytes() + layout_.offset(place);
  if (!values)
  {
    zero(columns_.schema()[place].bytes(), out, layout_.bytes(), count);
    return true;
  }
  if (colour_ == column)
  {
    largestColour_ = std::max(largestColour_, largest(values, count * attribute.components));
  }
  if (columns_.narrowed() == column)
  {
    const bool right = lowBytes(values, attribute.components, out, layout_.bytes(), count);
    wrong_[column] = wrong_[column] || !right;
    return right;
  }
  scatter(values, bytes, out, layout_.bytes(), count);
  return true;
}

void RecordPacker::addCells(std::size_t from)
{
  const RecordSpan view{ records_.data(), layout_.bytes() };
  for (std::size_t i = from; i < count_; ++i)
  {
    const auto objectClass =
      classOffset_ ? std::to_integer<std::uint8_t>(view.record(i)[*classOffset_]) : std::uint8_t(0);
    cells_.add(view.position(i), objectClass);
  }
}

std::vector<CellRun> RecordPacker::order()
{
  cells_.countInto(counts_);
  return cells_.order();
}

} // namespace pointfront
