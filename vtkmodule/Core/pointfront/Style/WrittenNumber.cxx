#include "pointfront/Style/WrittenNumber.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{
/// The nearest whole number of steps, if the difference is that of rounding alone.
ConditionNumber asSteps(ConditionNumber number, double scale, double offset)
{
  const auto written = static_cast<double>(number);
  const double steps = std::round((written - offset) / scale);
  const double value = steps * scale + offset;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() *
    std::max({ std::abs(written), std::abs(offset), std::abs(steps * scale) });
  return std::abs(value - written) <= rounding ? value : number;
}

/// The nearest float, if its shortest decimal is the number.
ConditionNumber asFloat(ConditionNumber number)
{
  const auto nearest = static_cast<float>(number);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), nearest).ptr;
  double written = 0.0;
  std::from_chars(text.data(), end, written);
  return written == static_cast<double>(number) ? static_cast<ConditionNumber>(nearest) : number;
}

ConditionNumber asWritten(
  ConditionNumber number, const AttributeCondition& condition, const Attribute* attribute)
{
  const double scale = attribute != nullptr ? attribute->scale : condition.axisScale;
  const double offset = attribute != nullptr ? attribute->offset : condition.axisOffset;
  const bool plain = scale == 1.0 && offset == 0.0;
  if (!std::isfinite(static_cast<double>(number)) || !(scale > 0.0))
  {
    return number;
  }
  if (attribute != nullptr && attribute->type == ScalarType::Float32 && plain)
  {
    return std::abs(static_cast<double>(number)) <= std::numeric_limits<float>::max()
      ? asFloat(number)
      : number;
  }
  const bool floating = attribute != nullptr &&
    (attribute->type == ScalarType::Float32 || attribute->type == ScalarType::Float64);
  return plain || floating ? number : asSteps(number, scale, offset);
}
} // namespace

void takeAsWritten(AttributeCondition& condition, const Attribute* attribute)
{
  for (ConditionNumber& end : condition.range)
  {
    end = asWritten(end, condition, attribute);
  }
  for (ConditionNumber& value : condition.values)
  {
    value = asWritten(value, condition, attribute);
  }
}

} // namespace pointfront
