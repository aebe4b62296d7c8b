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

void putFloating(double value, ScalarType type, std::byte* to)
{
  if (type == ScalarType::Float64)
  {
    put(&value, sizeof value, to);
    return;
  }
  const auto narrow = static_cast<float>(value);
  put(&narrow, sizeof narrow, to);
}
} // namespace

ScalarType RecordEncoder::add(
  std::size_t column, std::size_t component, std::optional<ScalarType> as)
{
  const Attribute& attribute = schema_[column];
  Part part;
  part.column = column;
  part.component = component;
  const bool scaled = attribute.scale != 1.0 || attribute.offset != 0.0;
  part.as = !as && scaled ? ScalarType::Float64 : as;
  part.offset = recordBytes_;
  parts_.push_back(part);
  const ScalarType type = part.as.value_or(attribute.type);
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

void RecordEncoder::encodePart(const Part& part, const PointBatch& batch, std::byte* records) const
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
  if (!part.as)
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
    putFloating(values[i] * attribute.scale + attribute.offset, *part.as, to);
  }
}

void RecordEncoder::encode(const PointBatch& batch, std::vector<std::byte>& records) const
{
  const std::size_t begin = records.size();
  records.resize(begin + batch.size() * recordBytes_);
  std::byte* const first = records.data() + begin;
  std::byte* to = first;
  const std::size_t bytes = sizeOf(coordinates_.type);
  for (const glm::dvec3& p : batch.positions)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      putFloating(p[axis] - coordinates_.origin[axis], coordinates_.type,
        to + bytes * static_cast<std::size_t>(axis));
    }
    to += recordBytes_;
  }
  for (const Part& part : parts_)
  {
    encodePart(part, batch, first);
  }
}

} // namespace pointfront
