#include "pointfront/Table/RecordEncoder.h"

#include "pointfront/Table/RecordNumbers.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
/// Copies one number, as the file has it.
void put(const void* from, std::size_t bytes, std::byte* to)
{
  std::memcpy(to, from, bytes);
  if (!machineIsLittleEndian())
  {
    std::reverse(to, to + bytes);
  }
}
} // namespace

ScalarType RecordEncoder::add(std::size_t column, std::size_t component, bool widened)
{
  const Attribute& attribute = schema_[column];
  Part part;
  part.column = column;
  part.component = component;
  part.widened = widened || attribute.scale != 1.0 || attribute.offset != 0.0;
  part.offset = recordBytes_;
  parts_.push_back(part);
  const ScalarType type = part.widened ? ScalarType::Float64 : attribute.type;
  recordBytes_ += sizeOf(type);
  return type;
}

void RecordEncoder::addByte(std::uint8_t value)
{
  Part part;
  part.value = value;
  part.offset = recordBytes_++;
  parts_.push_back(part);
}

void RecordEncoder::encodePart(
  const Part& part, const PointBatch& batch, std::byte* records) const
{
  std::byte* to = records + part.offset;
  if (!part.column)
  {
    for (std::size_t i = 0; i < batch.size(); ++i, to += recordBytes_)
    {
      *to = static_cast<std::byte>(part.value);
    }
    return;
  }
  const Attribute& attribute = schema_[*part.column];
  const std::size_t bytes = sizeOf(attribute.type);
  const std::byte* from = batch.columns[*part.column].data() + part.component * bytes;
  if (!part.widened)
  {
    for (std::size_t i = 0; i < batch.size(); ++i, to += recordBytes_)
    {
      put(from + i * attribute.bytes(), bytes, to);
    }
    return;
  }
  std::vector<double> values(batch.size());
  gatherNumbers({ from, attribute.bytes(), attribute.type, false }, values.size(), values.data());
  for (std::size_t i = 0; i < values.size(); ++i, to += recordBytes_)
  {
    const double world = values[i] * attribute.scale + attribute.offset;
    put(&world, sizeof world, to);
  }
}

void RecordEncoder::encode(const PointBatch& batch, std::vector<std::byte>& records) const
{
  const std::size_t begin = records.size();
  records.resize(begin + batch.size() * recordBytes_);
  std::byte* const first = records.data() + begin;
  std::byte* to = first;
  for (const glm::dvec3& p : batch.positions)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double value = p[axis];
      put(&value, sizeof value, to + sizeof value * static_cast<std::size_t>(axis));
    }
    to += recordBytes_;
  }
  for (const Part& part : parts_)
  {
    encodePart(part, batch, first);
  }
}

} // namespace pointfront
