#include "LAZIntegerEncoder.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
/// The smallest width w so that `difference` lies in [-(2^w - 1), 2^w].
std::uint32_t widthOf(std::int32_t difference)
{
  const std::int64_t wide = difference;
  const auto size = static_cast<std::uint64_t>(wide <= 0 ? -wide : wide - 1);
  std::uint32_t width = 0;
  while ((size >> width) != 0)
  {
    ++width;
  }
  return width;
}
} // namespace

LAZIntegerEncoder::LAZIntegerEncoder()
  : widths_{ LAZSymbolModel(lazIntegerBits + 1), LAZSymbolModel(lazIntegerBits + 1) }
{
  for (std::uint32_t width = 1; width <= lazIntegerBits; ++width)
  {
    highBits_.emplace_back(1u << std::min(width, lazModelledBits));
  }
}

/// Moves the interval up; a carry goes into the bytes that are out already.
void LAZIntegerEncoder::advance(std::uint32_t step)
{
  const std::uint32_t before = base_;
  base_ += step;
  if (before > base_)
  {
    for (auto at = bytes_.rbegin(); at != bytes_.rend(); ++at)
    {
      *at = static_cast<std::byte>(std::to_integer<unsigned>(*at) + 1);
      if (*at != std::byte{ 0 })
      {
        break;
      }
    }
  }
}

void LAZIntegerEncoder::renormalise()
{
  while (length_ < lazLeastInterval)
  {
    bytes_.push_back(static_cast<std::byte>(base_ >> 24));
    base_ <<= 8;
    length_ <<= 8;
  }
}

void LAZIntegerEncoder::symbol(LAZSymbolModel& model, std::uint32_t value)
{
  const std::uint32_t unit = length_ >> LAZSymbolModel::shift;
  const std::uint32_t lower = unit * model.distribution[value];
  const bool last = value + 1 == model.counts.size();
  const std::uint32_t upper = last ? length_ : unit * model.distribution[value + 1];
  advance(lower);
  length_ = upper - lower;
  renormalise();
  model.learn(value);
}

void LAZIntegerEncoder::bit(LAZBitModel& model, bool one)
{
  const std::uint32_t bound = model.zeroProbability * (length_ >> LAZBitModel::shift);
  if (one)
  {
    advance(bound);
    length_ -= bound;
  }
  else
  {
    length_ = bound;
  }
  renormalise();
  model.learn(one);
}

void LAZIntegerEncoder::bits(std::uint32_t value, std::uint32_t count)
{
  if (count > 19) // more than one step can hold
  {
    bits(value & 0xFFFFu, 16);
    value >>= 16;
    count -= 16;
  }
  length_ >>= count;
  advance(value * length_);
  renormalise();
}

void LAZIntegerEncoder::add(std::uint32_t prediction, std::uint32_t integer, int context)
{
  const auto difference = static_cast<std::int32_t>(integer - prediction);
  const std::uint32_t width = widthOf(difference);
  symbol(widths_[static_cast<std::size_t>(context)], width);
  if (width == 0)
  {
    bit(zeroOrOne_, difference == 1);
    return;
  }
  if (width >= lazIntegerBits)
  {
    return; // there is one such difference
  }
  const auto plain = static_cast<std::uint32_t>(difference);
  const std::uint32_t position = difference < 0 ? plain + ((1u << width) - 1) : plain - 1;
  const std::uint32_t lowBits = width > lazModelledBits ? width - lazModelledBits : 0;
  symbol(highBits_[width - 1], position >> lowBits);
  if (lowBits > 0)
  {
    bits(position & ((1u << lowBits) - 1), lowBits);
  }
}

/// As few bytes of the interval as tell it apart, then what the decoder reads ahead.
std::vector<std::byte> LAZIntegerEncoder::finish()
{
  const bool wide = length_ > 2 * lazLeastInterval;
  advance(wide ? lazLeastInterval : lazLeastInterval >> 1);
  length_ = wide ? lazLeastInterval >> 1 : lazLeastInterval >> 9;
  renormalise();
  bytes_.resize(bytes_.size() + (wide ? 3 : 2));
  return std::move(bytes_);
}

} // namespace pointfront
