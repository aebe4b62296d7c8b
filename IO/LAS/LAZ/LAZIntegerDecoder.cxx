#include "LAZIntegerDecoder.h"

#include <algorithm>

namespace pointfront
{
LAZIntegerDecoder::LAZIntegerDecoder(ByteSpan bytes)
  : bytes_(bytes)
  , widths_{ LAZSymbolModel(lazIntegerBits + 1), LAZSymbolModel(lazIntegerBits + 1) }
{
  for (std::uint32_t width = 1; width <= lazIntegerBits; ++width)
  {
    highBits_.emplace_back(1u << std::min(width, lazModelledBits));
  }
  for (int i = 0; i < 4; ++i)
  {
    value_ = (value_ << 8) | byte();
  }
}

std::optional<std::uint32_t> LAZIntegerDecoder::next(std::uint32_t prediction, int context)
{
  const std::uint32_t integer = prediction + difference(widths_[static_cast<std::size_t>(context)]);
  return sound_ ? std::optional<std::uint32_t>(integer) : std::nullopt;
}

std::uint32_t LAZIntegerDecoder::byte()
{
  if (at_ >= bytes_.size)
  {
    sound_ = false;
    return 0;
  }
  return std::to_integer<std::uint32_t>(bytes_.data[at_++]);
}

void LAZIntegerDecoder::renormalise()
{
  while (length_ < lazLeastInterval)
  {
    value_ = (value_ << 8) | byte();
    length_ <<= 8;
    if (length_ == 0) // only bytes that no encoder wrote lead here
    {
      sound_ = false;
      length_ = 0xFFFFFFFFu;
    }
  }
}

std::uint32_t LAZIntegerDecoder::symbol(LAZSymbolModel& model)
{
  std::uint32_t upper = length_;
  length_ >>= LAZSymbolModel::shift;
  std::uint32_t lower = 0;
  std::uint32_t found = 0;
  auto end = static_cast<std::uint32_t>(model.counts.size());
  for (std::uint32_t k = end >> 1; k != found; k = (found + end) >> 1)
  {
    const std::uint32_t bound = length_ * model.distribution[k];
    if (bound > value_)
    {
      end = k;
      upper = bound;
    }
    else
    {
      found = k;
      lower = bound;
    }
  }
  value_ -= lower;
  length_ = upper - lower;
  renormalise();
  model.learn(found);
  return found;
}

std::uint32_t LAZIntegerDecoder::bit(LAZBitModel& model)
{
  const std::uint32_t bound = model.zeroProbability * (length_ >> LAZBitModel::shift);
  const bool one = value_ >= bound;
  if (one)
  {
    value_ -= bound;
    length_ -= bound;
  }
  else
  {
    length_ = bound;
  }
  renormalise();
  model.learn(one);
  return one ? 1 : 0;
}

std::uint32_t LAZIntegerDecoder::bits(std::uint32_t count)
{
  if (count > 19) // more than one step can hold
  {
    const std::uint32_t low = bits(16);
    return (bits(count - 16) << 16) | low;
  }
  length_ >>= count;
  const std::uint32_t found = value_ / length_;
  value_ -= length_ * found;
  sound_ = sound_ && found < (1u << count);
  renormalise();
  return found;
}

/// The difference lies in [-(2^w - 1), 2^w], outside the interval of the next smaller width w.
/// Arithmetic is modulo 2^32, as the encoder's.
std::uint32_t LAZIntegerDecoder::difference(LAZSymbolModel& widthModel)
{
  const std::uint32_t width = symbol(widthModel);
  if (width == 0)
  {
    return bit(zeroOrOne_);
  }
  if (width >= lazIntegerBits)
  {
    return 0x80000000u;
  }
  std::uint32_t position = symbol(highBits_[width - 1]);
  if (width > lazModelledBits)
  {
    const std::uint32_t lowBits = width - lazModelledBits;
    position = (position << lowBits) | bits(lowBits);
  }
  return position >= (1u << (width - 1)) ? position + 1 : position - ((1u << width) - 1);
}

} // namespace pointfront
