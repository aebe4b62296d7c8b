#include "pointfront/Means/MeanRecord.h"

#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Trees/BuiltTree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

namespace pointfront
{
namespace
{
template <typename T>
T valueAt(const std::byte* at)
{
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

template <typename T>
void setValue(std::byte* at, T value)
{
  std::memcpy(at, &value, sizeof(T));
}

/// std::round() without the call: the fraction is exact, and exact halves go away from zero.
double roundedAway(double value)
{
  constexpr double wholeFrom = 4503599627370496.0; // 2^52: no larger double has a fraction
  if (!(std::abs(value) < wholeFrom))
  {
    return value;
  }
  const auto whole = static_cast<double>(static_cast<std::int64_t>(value));
  const double fraction = value - whole;
  return whole + (fraction >= 0.5 ? 1.0 : 0.0) - (fraction <= -0.5 ? 1.0 : 0.0);
}

template <typename T>
void setNearest(std::byte* at, double value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    setValue<T>(at, static_cast<T>(value));
  }
  else
  {
    const double low = static_cast<double>(std::numeric_limits<T>::lowest());
    const double high = static_cast<double>(std::numeric_limits<T>::max());
    const double whole = roundedAway(value);
    // The largest 64-bit integers are no doubles: compare before the cast.
    setValue<T>(at,
      whole >= high    ? std::numeric_limits<T>::max()
        : whole <= low ? std::numeric_limits<T>::lowest()
                       : static_cast<T>(whole));
  }
}

void writeScalar(ScalarType type, std::byte* at, double value)
{
  visitScalar(type, [&](auto zero) { setNearest<decltype(zero)>(at, value); });
}

constexpr std::size_t centreOffset = sizeof(double); // behind the weight
constexpr std::size_t headBytes = 4 * sizeof(double);
} // namespace

bool hasMean(const Attribute& attribute)
{
  const bool fractional =
    attribute.type == ScalarType::Float32 || attribute.type == ScalarType::Float64;
  const bool scaled = attribute.scale != 1.0 || attribute.offset != 0.0;
  return fractional || scaled || attribute.name == "intensity" || attribute.name == "rgb" ||
    attribute.name == "nir";
}

MeanRecord::MeanRecord(const TreeSpace& space, const AttributeSchema& pooled)
{
  const RecordLayout layout(pooled);
  assert(!pooled.empty() && pooled[pooled.size() - 1].name == enclosingRadiusName);
  recordBytes_ = layout.bytes();
  radiusOffset_ = layout.offset(pooled.size() - 1);
  meansOffset_ = recordBytes_ + headBytes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const unsigned shift = space.shift[static_cast<std::size_t>(axis)];
    gridStep_[axis] = 1u << shift;
    stepLength_[axis] = std::ldexp(space.grid.scale[axis], -static_cast<int>(shift));
  }
  for (std::size_t c = 0; c + 1 < pooled.size(); ++c)
  {
    const Attribute& attribute = pooled[c];
    if (attribute.name == splatRadiusAttribute && attribute.bytes() == 1)
    {
      splatOffset_ = layout.offset(c);
    }
    for (std::size_t k = 0; hasMean(attribute) && k < attribute.components; ++k)
    {
      Mean mean;
      mean.offset = layout.offset(c) + k * sizeOf(attribute.type);
      mean.type = attribute.type;
      mean.normal = k == 0 && attribute.name == "normal" && attribute.components == 3;
      mean.scale = attribute.scale;
      mean.zero = attribute.offset;
      means_.push_back(mean);
    }
  }
}

double MeanRecord::weightOf(const MeanInput& input) const
{
  return input.original ? 1.0 : valueAt<double>(input.record + recordBytes_);
}

glm::dvec3 MeanRecord::centreOf(const MeanInput& input) const
{
  return input.original ? glm::dvec3(positionOf(input.record))
                        : valueAt<glm::dvec3>(input.record + recordBytes_ + centreOffset);
}

TreePosition MeanRecord::onGrid(const glm::dvec3& centre) const
{
  TreePosition position;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double step = gridStep_[axis];
    position[axis] = static_cast<std::uint32_t>(roundedAway(centre[axis] / step) * step);
  }
  return position;
}

template <typename T>
void MeanRecord::addMean(
  Mean& mean, std::size_t exactOffset, const MeanInput* first, const MeanInput* last) const
{
  double sum = 0.0;
  double weight = 0.0;
  for (const MeanInput* input = first; input != last; ++input)
  {
    const double value = input->original
      ? static_cast<double>(valueAt<T>(input->record + mean.offset))
      : valueAt<double>(input->record + exactOffset);
    if (std::is_integral_v<T> || !std::isnan(value))
    {
      const double own = weightOf(*input);
      sum += own * value;
      weight += own;
    }
  }
  mean.sum = sum;
  mean.weight = weight;
}

/// Value by value, not input by input: the type is asked for once.
void MeanRecord::addMeans(const MeanInput* first, const MeanInput* last)
{
  std::size_t exactOffset = meansOffset_;
  for (Mean& mean : means_)
  {
    visitScalar(
      mean.type, [&](auto zero) { addMean<decltype(zero)>(mean, exactOffset, first, last); });
    exactOffset += sizeof(double);
  }
}

void MeanRecord::writeMeans(std::byte* out)
{
  for (std::size_t m = 0; m < means_.size(); ++m)
  {
    const double value = means_[m].weight > 0.0 ? means_[m].sum / means_[m].weight
                                                : std::numeric_limits<double>::quiet_NaN();
    setValue(out + meansOffset_ + m * sizeof(double), value);
    if (means_[m].weight > 0.0)
    {
      writeScalar(means_[m].type, out + means_[m].offset, value);
    }
  }
  for (std::size_t m = 0; m + 2 < means_.size(); ++m)
  {
    if (means_[m].normal)
    {
      writeUnitNormal(m, out);
    }
  }
}

/// Length 1 once the column's scale is applied: the stored numbers may be steps of a
/// ten-thousandth.
void MeanRecord::writeUnitNormal(std::size_t first, std::byte* out) const
{
  const double scale = means_[first].scale;
  const double zero = means_[first].zero;
  const auto mean = valueAt<glm::dvec3>(out + meansOffset_ + first * sizeof(double));
  const glm::dvec3 normal = mean * scale + zero;
  const double length = glm::length(normal);
  for (int k = 0; length > 0.0 && k < 3; ++k)
  {
    const Mean& component = means_[first + static_cast<std::size_t>(k)];
    writeScalar(component.type, out + component.offset, (normal[k] / length - zero) / scale);
  }
}

/// One input stands for itself: no mean gives back NaN, a negative zero, an integer
/// that is no double or a normal of another length.
void MeanRecord::keep(const MeanInput& input, std::byte* out) const
{
  if (!input.original)
  {
    copyRecord(out, input.record, bytes());
    return;
  }
  copyRecord(out, input.record, recordBytes_);
  setValue(out + recordBytes_, weightOf(input));
  setValue(out + recordBytes_ + centreOffset, centreOf(input));
  for (std::size_t m = 0; m < means_.size(); ++m)
  {
    visitScalar(means_[m].type,
      [&](auto zero)
      {
        const auto value = valueAt<decltype(zero)>(input.record + means_[m].offset);
        setValue(out + meansOffset_ + m * sizeof(double), static_cast<double>(value));
      });
  }
}

void MeanRecord::summarise(
  const std::vector<MeanInput>& inputs, std::size_t begin, std::size_t end, std::byte* out)
{
  if (end - begin == 1)
  {
    keep(inputs[begin], out);
    return;
  }
  double weight = 0.0;
  glm::dvec3 centre(0.0);
  for (std::size_t i = begin; i < end; ++i)
  {
    const double own = weightOf(inputs[i]);
    weight += own;
    centre += own * centreOf(inputs[i]);
  }
  addMeans(inputs.data() + begin, inputs.data() + end);
  centre /= weight;
  const TreePosition stored = onGrid(centre);
  double radius = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  const std::byte* kept = nullptr;
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::byte* record = inputs[i].record;
    const glm::dvec3 position(positionOf(record));
    const double own = inputs[i].original ? 0.0 : valueAt<float>(record + radiusOffset_);
    const double distance = glm::length((position - glm::dvec3(stored)) * stepLength_);
    radius = std::max(radius, distance + own);
    if (distance < nearest)
    {
      nearest = distance;
      kept = record;
    }
  }
  copyRecord(out, kept, recordBytes_);
  setPosition(out, stored);
  setValue(out + radiusOffset_, roundedUp(radius));
  setValue(out + recordBytes_, weight);
  setValue(out + recordBytes_ + centreOffset, centre);
  writeMeans(out);
}

void MeanRecord::forgetSplat(std::byte* record) const
{
  if (splatOffset_)
  {
    record[*splatOffset_] = std::byte(unknownSplatRadius);
  }
}

} // namespace pointfront
