#include "pointfront/Export/EightBitColourSink.h"

#include <array>
#include <cstring>
#include <utility>

namespace pointfront
{
namespace
{
constexpr unsigned maximum = 255;
}

EightBitColourSink::EightBitColourSink(std::unique_ptr<PointSink> sink)
  : ForwardingSink(std::move(sink))
{
}

Result<void> EightBitColourSink::begin(const SinkDescription& description)
{
  SinkDescription result = description;
  for (std::size_t c = 0; c < description.schema.size(); ++c)
  {
    Attribute attribute = description.schema[c];
    if (attribute.name != "rgb" || attribute.components != 3 ||
      attribute.type != ScalarType::UInt16)
    {
      continue;
    }
    colours_ = c;
    attribute.type = ScalarType::UInt8;
    result.schema = {};
    for (std::size_t k = 0; k < description.schema.size(); ++k)
    {
      result.schema.add(k == c ? attribute : description.schema[k]);
    }
    if (c < description.largest.size())
    {
      areSmall_ = description.largest[c] <= maximum;
      result.largest[c] = areSmall_ ? description.largest[c] : maximum;
    }
  }
  return ForwardingSink::begin(result);
}

void EightBitColourSink::narrow(const std::vector<std::byte>& wide, std::vector<std::byte>& bytes)
{
  using Colour = std::array<std::uint16_t, 3>;
  const std::size_t points = wide.size() / sizeof(Colour);
  bytes.resize(3 * points);
  for (std::size_t i = 0; i < points; ++i)
  {
    Colour colour;
    std::memcpy(&colour, wide.data() + i * sizeof colour, sizeof colour);
    bool isExact = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const unsigned upper = colour[k] >> 8;
      const unsigned lower = colour[k] & maximum;
      wasMisjudged_ = wasMisjudged_ || (areSmall_ && upper != 0);
      isExact = isExact && (areSmall_ || lower == 0 || lower == upper);
      bytes[3 * i + k] = static_cast<std::byte>(areSmall_ ? lower : upper);
    }
    rounded_ += isExact ? 0 : 1;
  }
}

Result<void> EightBitColourSink::append(const PointBatch& batch)
{
  if (!colours_)
  {
    return ForwardingSink::append(batch);
  }
  batch_.positions = batch.positions;
  batch_.steps = batch.steps;
  batch_.columns.resize(batch.columns.size());
  for (std::size_t c = 0; c < batch.columns.size(); ++c)
  {
    if (c == *colours_)
    {
      narrow(batch.columns[c], batch_.columns[c]);
      if (wasMisjudged_)
      {
        return makeError(Error::Kind::BadArgument,
          path() +
            ": some colours are above 255, and the first points that were looked at have none; "
            "export with --color-depth 16");
      }
    }
    else
    {
      batch_.columns[c] = batch.columns[c];
    }
  }
  return ForwardingSink::append(batch_);
}

std::vector<std::string> EightBitColourSink::findings() const
{
  std::vector<std::string> all = ForwardingSink::findings();
  if (rounded_ > 0)
  {
    all.push_back("It has the upper 8 of 16 bits of the colours, as readers of such files expect, "
                  "which rounds those of " +
      std::to_string(rounded_) + " points; --color-depth 16 keeps all bits.");
  }
  return all;
}

} // namespace pointfront
