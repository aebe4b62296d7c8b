#include "LASPointDecoder.h"

#include "LASBytes.h"

#include <algorithm>

namespace pointfront
{
namespace
{
/// Records handled together: 16 to 40 KiB of input, inside a level 1 or 2 cache.
constexpr std::size_t decodedPoints = 512;

/// `count` records of `stride` bytes.
struct Records
{
  const std::byte* first;
  std::size_t stride;
  std::size_t count;
};

void decodePositions(const Records& records, const QuantisationGrid& grid, glm::dvec3* to)
{
  const std::byte* from = records.first;
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride)
  {
    to[i].x = grid.offset.x + grid.scale.x * loadNumber<std::int32_t>(from);
    to[i].y = grid.offset.y + grid.scale.y * loadNumber<std::int32_t>(from + 4);
    to[i].z = grid.offset.z + grid.scale.z * loadNumber<std::int32_t>(from + 8);
  }
}

void decodeSteps(const Records& records, glm::ivec3* to)
{
  const std::byte* from = records.first;
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride)
  {
    std::memcpy(to + i, from, sizeof(*to)); // x, y, z are the first 12 bytes of every format
  }
}

/// Width known when compiled: each copy is one or two moves.
template <std::size_t Width>
void copyFixed(const Records& records, const std::byte* from, std::byte* to)
{
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride, to += Width)
  {
    std::memcpy(to, from, Width);
  }
}

void copyAny(const Records& records, const std::byte* from, std::size_t width, std::byte* to)
{
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride, to += width)
  {
    std::memcpy(to, from, width);
  }
}

void copyField(const Records& records, const std::byte* from, std::size_t width, std::byte* to)
{
  switch (width)
  {
    case 1:
      return copyFixed<1>(records, from, to);
    case 2:
      return copyFixed<2>(records, from, to);
    case 4:
      return copyFixed<4>(records, from, to);
    case 6:
      return copyFixed<6>(records, from, to);
    case 8:
      return copyFixed<8>(records, from, to);
    case 12:
      return copyFixed<12>(records, from, to);
    case 24:
      return copyFixed<24>(records, from, to);
    default:
      return copyAny(records, from, width, to);
  }
}

void decodeBits(const Records& records, const std::byte* from, const LASField& field, std::byte* to)
{
  const unsigned shift = field.shift;
  const unsigned mask = field.mask;
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride)
  {
    to[i] = static_cast<std::byte>((std::to_integer<unsigned>(*from) >> shift) & mask);
  }
}

/// Degrees = integer * `degrees`, rounded once to float32.
template <typename Integer>
void decodeAngle(const Records& records, const std::byte* from, double degrees, std::byte* to)
{
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride, to += sizeof(float))
  {
    storeNumber(to, static_cast<float>(degrees * loadNumber<Integer>(from)));
  }
}

void decodeColumn(const Records& records, const LASField& field, std::size_t width, std::byte* to)
{
  const std::byte* from = records.first + field.offset;
  switch (field.kind)
  {
    case LASField::Kind::Copy:
      return copyField(records, from, width, to);
    case LASField::Kind::Bits:
      return decodeBits(records, from, field, to);
    case LASField::Kind::Angle8:
      return decodeAngle<std::int8_t>(records, from, 1.0, to);
    case LASField::Kind::Angle16:
      return decodeAngle<std::int16_t>(records, from, 0.006, to);
  }
}
} // namespace

void decodeLASPoints(const LASPointLayout& layout, const QuantisationGrid& grid,
  const std::byte* records, std::size_t count, PointBatch& batch, std::size_t first)
{
  for (std::size_t begin = 0; begin < count; begin += decodedPoints)
  {
    const Records block{ records + begin * layout.pointBytes, layout.pointBytes,
      std::min(decodedPoints, count - begin) };
    if (batch.steps.empty())
    {
      decodePositions(block, grid, batch.positions.data() + first + begin);
    }
    else
    {
      decodeSteps(block, batch.steps.data() + first + begin);
    }
    for (std::size_t c = 0; c < layout.fields.size(); ++c)
    {
      const std::size_t width = layout.schema[c].bytes();
      std::byte* to = batch.columns[c].data() + (first + begin) * width;
      decodeColumn(block, layout.fields[c], width, to);
    }
  }
}

void decodeLASColumn(const LASPointLayout& layout, std::size_t column, const std::byte* records,
  std::size_t count, std::byte* to)
{
  decodeColumn(Records{ records, layout.pointBytes, count }, layout.fields[column],
    layout.schema[column].bytes(), to);
}

} // namespace pointfront
