#include "LASPointEncoder.h"

#include "LASBytes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace pointfront
{
namespace
{
/// Values that all the functions below need.
struct Work
{
  const LASExport& plan;
  const std::string& path;
  const PointBatch& batch;
  std::size_t first;
  std::size_t count;
  std::byte* records;
  std::uint64_t number; ///< in the file, of point `first`
  LASTotals& totals;
};

Error cannotHold(const Work& work, std::size_t i, const std::string& what)
{
  return makeError(Error::Kind::BadArgument,
    work.path + ": point " + std::to_string(work.number + i) + " has " + what +
      ", which LAS point format " + std::to_string(work.plan.layout.pointFormat) +
      " cannot hold; leave that attribute out, or write another format");
}

Result<void> encodePositions(const Work& work)
{
  LASTotals& totals = work.totals;
  const QuantisationGrid& grid = work.plan.grid;
  std::byte* to = work.records;
  for (std::size_t i = 0; i < work.count; ++i, to += work.plan.layout.pointBytes)
  {
    const glm::dvec3& p = work.batch.positions[work.first + i];
    for (int axis = 0; axis < 3; ++axis)
    {
      // Compared as double: a number beyond 64 bits must not reach toGrid.
      const double steps = std::round((p[axis] - grid.offset[axis]) / grid.scale[axis]);
      if (!(steps >= std::numeric_limits<std::int32_t>::min() &&
            steps <= std::numeric_limits<std::int32_t>::max()))
      {
        return cannotHold(work, i,
          std::string(1, "xyz"[axis]) + " = " + std::to_string(p[axis]) + " at a step of " +
            std::to_string(grid.scale[axis]) + " from " + std::to_string(grid.offset[axis]));
      }
      storeNumber(to + 4 * axis, static_cast<std::int32_t>(steps));
      const auto integer = static_cast<std::int64_t>(steps);
      const bool start = totals.points == 0 && i == 0;
      totals.low[axis] = start ? integer : std::min(totals.low[axis], integer);
      totals.high[axis] = start ? integer : std::max(totals.high[axis], integer);
    }
  }
  return {};
}

/// One element of a column for each point.
struct Elements
{
  const std::byte* first;
  std::size_t stride;
};

void encodeCopy(const Work& work, const Elements& from, std::size_t width, std::byte* to)
{
  const std::byte* element = from.first;
  for (std::size_t i = 0; i < work.count; ++i)
  {
    std::memcpy(to, element, width);
    element += from.stride;
    to += work.plan.layout.pointBytes;
  }
}

/// Values of 8 bits in fields of 16: the same numbers.
void encodeWidened(const Work& work, const Elements& from, std::size_t components, std::byte* to)
{
  const std::byte* element = from.first;
  for (std::size_t i = 0; i < work.count; ++i)
  {
    for (std::size_t k = 0; k < components; ++k)
    {
      storeNumber(to + 2 * k, static_cast<std::uint16_t>(element[k]));
    }
    element += from.stride;
    to += work.plan.layout.pointBytes;
  }
}

Result<void> encodeBits(const Work& work, const Elements& from, const Attribute& attribute,
  const LASField& field, std::byte* to)
{
  const std::byte* element = from.first;
  for (std::size_t i = 0; i < work.count; ++i)
  {
    const auto value = std::to_integer<unsigned>(*element);
    if (value > field.mask)
    {
      return cannotHold(work, i, attribute.name + " " + std::to_string(value));
    }
    *to |= static_cast<std::byte>(value << field.shift);
    element += from.stride;
    to += work.plan.layout.pointBytes;
  }
  return {};
}

/// `replaced`: counts angles that are out of range; null: they are an error.
template <typename Integer>
Result<void> encodeAngle(
  const Work& work, const Elements& from, double degrees, std::byte* to, std::uint64_t* replaced)
{
  const std::byte* element = from.first;
  for (std::size_t i = 0; i < work.count; ++i)
  {
    const auto angle = loadNumber<float>(element);
    double steps = std::round(angle / degrees);
    const bool inRange =
      steps >= std::numeric_limits<Integer>::min() && steps <= std::numeric_limits<Integer>::max();
    if (!inRange && replaced != nullptr)
    {
      ++*replaced;
      steps = 0.0;
    }
    else if (!inRange)
    {
      return cannotHold(work, i, "a scan_angle of " + std::to_string(angle) + " degrees");
    }
    else if (static_cast<float>(degrees * steps) != angle)
    {
      ++work.totals.roundedAngles;
    }
    storeNumber(to, static_cast<Integer>(steps));
    element += from.stride;
    to += work.plan.layout.pointBytes;
  }
  return {};
}

/// The values in the type of their field.
/// Errors  BadArgument: one that the type does not hold, where the ranges did not tell.
Result<std::vector<std::byte>> converted(
  const Work& work, const Elements& from, ScalarType type, const Attribute& field)
{
  std::vector<std::byte> all(work.count * field.bytes());
  std::optional<std::size_t> wrong;
  visitScalar(type,
    [&](auto source)
    {
      visitScalar(field.type,
        [&](auto target)
        {
          using Source = decltype(source);
          using Target = decltype(target);
          for (std::size_t i = 0; i < work.count * field.components; ++i)
          {
            const std::size_t point = i / field.components;
            const auto value = loadNumber<Source>(
              from.first + point * from.stride + (i % field.components) * sizeof(Source));
            if constexpr (!std::is_floating_point_v<Target>)
            {
              // As a double: what is cut off there is out of any field's range.
              const auto number = static_cast<double>(value);
              if (!(number >= static_cast<double>(std::numeric_limits<Target>::lowest()) &&
                    number <= static_cast<double>(std::numeric_limits<Target>::max())))
              {
                wrong = wrong ? wrong : point;
                continue;
              }
            }
            storeNumber(all.data() + i * sizeof(Target), static_cast<Target>(value));
          }
        });
    });
  if (wrong)
  {
    return cannotHold(work, *wrong, "a value of '" + field.name + "'");
  }
  return all;
}

/// The values in the type of their field, and Origin::instead for those that are beyond it; their
/// number is added to `replaced`. All fields of integers are unsigned.
std::vector<std::byte> narrowed(const Work& work, const Elements& from,
  const LASExport::Origin& origin, const Attribute& attribute, const LASField& field,
  std::uint64_t& replaced)
{
  std::vector<std::byte> all(work.count * attribute.bytes());
  visitScalar(origin.type,
    [&](auto source)
    {
      visitScalar(attribute.type,
        [&](auto target)
        {
          using Source = decltype(source);
          using Target = decltype(target);
          if constexpr (std::is_integral_v<Source> && std::is_unsigned_v<Target>)
          {
            const bool bits = field.kind == LASField::Kind::Bits;
            const Target largest = bits ? Target{ field.mask } : std::numeric_limits<Target>::max();
            for (std::size_t i = 0; i < work.count; ++i)
            {
              const auto value = loadNumber<Source>(from.first + i * from.stride);
              const bool fits = value >= 0 && static_cast<std::uint64_t>(value) <= largest;
              replaced += fits ? 0 : 1;
              storeNumber(all.data() + i * sizeof(Target),
                fits ? static_cast<Target>(value) : Target{ origin.instead });
            }
          }
        });
    });
  return all;
}

Result<void> encodeColumn(
  const Work& work, std::size_t c, LASExport::Origin origin, std::size_t stride)
{
  const LASField& field = work.plan.layout.fields[c];
  const Attribute& attribute = work.plan.layout.schema[c];
  Elements from{ work.batch.columns[origin.column].data() + work.first * stride + origin.byte,
    stride };
  std::vector<std::byte> own;
  const bool widened = origin.type == ScalarType::UInt8 && attribute.type == ScalarType::UInt16;
  std::uint64_t* const replaced = origin.partly ? &work.totals.replaced[c] : nullptr;
  if (replaced != nullptr && attribute.type != ScalarType::Float32)
  {
    own = narrowed(work, from, origin, attribute, field, *replaced);
    from = { own.data(), attribute.bytes() };
    origin.type = attribute.type;
  }
  else if (origin.type != attribute.type && !widened)
  {
    Result<std::vector<std::byte>> made = converted(work, from, origin.type, attribute);
    if (!made)
    {
      return made.error();
    }
    own = std::move(*made);
    from = { own.data(), attribute.bytes() };
    origin.type = attribute.type;
  }
  std::byte* to = work.records + field.offset;
  switch (field.kind)
  {
    case LASField::Kind::Bits:
      return encodeBits(work, from, attribute, field, to);
    case LASField::Kind::Angle8:
      return encodeAngle<std::int8_t>(work, from, 1.0, to, replaced);
    case LASField::Kind::Angle16:
      return encodeAngle<std::int16_t>(work, from, 0.006, to, replaced);
    case LASField::Kind::Copy:
      break;
  }
  if (origin.type == attribute.type)
  {
    encodeCopy(work, from, attribute.bytes(), to);
  }
  else
  {
    encodeWidened(work, from, attribute.components, to);
  }
  return {};
}

void countReturns(const Work& work)
{
  LASTotals& totals = work.totals;
  // Byte 14 of every format begins with the return number: 3 bits, or 4 from format 6 on.
  const unsigned mask = work.plan.layout.pointFormat < 6 ? 7 : 15;
  const std::byte* flags = work.records + 14;
  for (std::size_t i = 0; i < work.count; ++i, flags += work.plan.layout.pointBytes)
  {
    const unsigned number = std::to_integer<unsigned>(*flags) & mask;
    if (number > 0)
    {
      ++totals.byReturn[number - 1];
    }
  }
  totals.points += work.count;
}
} // namespace

Result<void> encodeLASPoints(const LASExport& plan, const std::string& path,
  const PointBatch& batch, std::size_t first, std::size_t count, std::vector<std::byte>& records,
  LASTotals& totals)
{
  records.assign(count * plan.layout.pointBytes, std::byte{ 0 });
  totals.replaced.resize(plan.origins.size());
  const Work work{ plan, path, batch, first, count, records.data(), totals.points, totals };
  if (auto done = encodePositions(work); !done)
  {
    return done;
  }
  for (std::size_t c = 0; c < plan.origins.size(); ++c)
  {
    if (!plan.origins[c])
    {
      continue;
    }
    const LASExport::Origin& origin = *plan.origins[c];
    const std::size_t stride = batch.columns[origin.column].size() / batch.size();
    if (auto done = encodeColumn(work, c, origin, stride); !done)
    {
      return done;
    }
  }
  countReturns(work);
  return {};
}

} // namespace pointfront
