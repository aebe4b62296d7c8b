#include "pointfront/Table/RecordEncoder.h"

#include "pointfront/Table/RecordNumbers.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

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

/// How many of the integers at equal distances float64 does not hold.
std::uint64_t countInexact(
  const std::byte* from, std::size_t stride, ScalarType type, std::size_t count)
{
  std::uint64_t inexact = 0;
  visitScalar(type,
    [&](auto zero)
    {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T> && sizeof(T) > 4)
      {
        const double beyond = 2.0 * static_cast<double>(std::numeric_limits<T>::max() / 2 + 1);
        for (std::size_t i = 0; i < count; ++i, from += stride)
        {
          T value;
          std::memcpy(&value, from, sizeof value);
          const auto number = static_cast<double>(value);
          inexact += number < beyond && static_cast<T>(number) == value ? 0 : 1;
        }
      }
    });
  return inexact;
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

void RecordEncoder::encodePart(const Part& part, const PointBatch& batch, std::byte* records)
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
  rounded_[*part.column] += countInexact(from, attribute.bytes(), attribute.type, batch.size());
  std::vector<double> values(batch.size());
  gatherNumbers({ from, attribute.bytes(), attribute.type, false }, values.size(), values.data());
  for (std::size_t i = 0; i < values.size(); ++i, to += recordBytes_)
  {
    putFloating(values[i] * attribute.scale + attribute.offset, *part.as, to);
  }
}

void RecordEncoder::encode(const PointBatch& batch, std::vector<std::byte>& records)
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

std::vector<std::string> RecordEncoder::findings() const
{
  std::vector<std::string> found;
  for (std::size_t c = 0; c < rounded_.size(); ++c)
  {
    if (rounded_[c] > 0)
    {
      found.push_back(std::to_string(rounded_[c]) + " values of '" + schema_[c].name +
        "' are rounded: they are written as float64, which does not hold all integers beyond "
        "2^53. A LAS file keeps them.");
    }
  }
  return found;
}

} // namespace pointfront
