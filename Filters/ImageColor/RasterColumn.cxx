#include "RasterColumn.h"

#include "OwnColours.h"

#include "pointfront/Points/WidenedColour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{
template <typename T>
T load(const std::byte* from)
{
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

double asDouble(ScalarType type, const std::byte* from)
{
  return visitScalar(
    type, [&](auto zero) { return static_cast<double>(load<decltype(zero)>(from)); });
}

/// Stores `value` if the type holds it: integers exactly, float rounded. False otherwise.
bool storeDouble(double value, ScalarType type, std::byte* to)
{
  return visitScalar(type,
    [&](auto zero)
    {
      using To = decltype(zero);
      if constexpr (std::is_integral_v<To>)
      {
        // 2^n - 1 is no double for 64 bits, 2^n is.
        const double end = std::ldexp(1.0, std::numeric_limits<To>::digits);
        const double begin = std::is_signed_v<To> ? -end : 0.0;
        if (!(value >= begin && value < end) || value != std::trunc(value))
        {
          return false;
        }
      }
      const To stored = static_cast<To>(value);
      std::memcpy(to, &stored, sizeof stored);
      return true;
    });
}

/// An element of a pixel as the file has it.
double elementOf(const RasterFile& file, const std::byte* from)
{
  const double read = asDouble(file.type, from);
  if (file.spreadBits == 0)
  {
    return read;
  }
  const double most = std::ldexp(1.0, file.spreadBits) - 1.0;
  const double value = std::round(read * most / (file.type == ScalarType::UInt8 ? 255.0 : 65535.0));
  return file.spreadInverted ? most - value : value;
}

bool withoutData(const RasterFile& file, const std::byte* pixel)
{
  const std::size_t bytes = sizeOf(file.type);
  if (file.alphaChannel >= 0 &&
    asDouble(file.type, pixel + static_cast<std::size_t>(file.alphaChannel) * bytes) == 0.0)
  {
    return true;
  }
  const bool floating = file.type == ScalarType::Float32 || file.type == ScalarType::Float64;
  if (!file.noData && !floating)
  {
    return false;
  }
  // The value in the tag is decimal, the pixel perhaps a float.
  const double none = !file.noData     ? std::nan("")
    : file.type == ScalarType::Float32 ? static_cast<double>(static_cast<float>(*file.noData))
                                       : *file.noData;
  for (int channel = 0; channel < file.channels; ++channel)
  {
    const double value = elementOf(file, pixel + static_cast<std::size_t>(channel) * bytes);
    if (channel != file.alphaChannel && !std::isnan(value) && value != none)
    {
      return false;
    }
  }
  return true;
}

/// Red, green or blue of a pixel, 8 or 16 bits.
unsigned colourOf(const RasterFile& file, const std::byte* pixel, std::size_t which)
{
  const bool wide = file.type == ScalarType::UInt16;
  if (!file.colours.empty())
  {
    const std::size_t index = wide ? load<std::uint16_t>(pixel) : std::to_integer<unsigned>(*pixel);
    return index < file.colours.size() ? file.colours[index][which] : 0;
  }
  const std::size_t channel = file.dataChannels() < 3 ? 0 : which;
  const unsigned value =
    wide ? load<std::uint16_t>(pixel + 2 * channel) : std::to_integer<unsigned>(pixel[channel]);
  return !file.whiteIsZero ? value : (wide ? 65535 : 255) - value;
}

/// Types that programs expect under well-known names (AttributeSchema).
ScalarType typeOfNew(const std::string& name, ScalarType ofImages)
{
  static const std::array<std::pair<const char*, ScalarType>, 5> known{
    { { "intensity", ScalarType::UInt16 }, { "classification", ScalarType::UInt8 },
      { "user_data", ScalarType::UInt8 }, { "point_source_id", ScalarType::UInt16 },
      { "nir", ScalarType::UInt16 } }
  };
  const auto found = std::find_if(
    known.begin(), known.end(), [&](const auto& entry) { return name == entry.first; });
  return found == known.end() ? ofImages : found->second;
}
} // namespace

Result<RasterColumn> RasterColumn::make(const std::string& name,
  const std::vector<RasterFile>& files, const PointSource& source, const PassResources& resources)
{
  RasterColumn column;
  column.colour_ = files.front().use == RasterUse::Colour;
  Attribute wanted;
  wanted.name = name;
  if (column.colour_)
  {
    const auto wide = std::find_if(
      files.begin(), files.end(), [](const RasterFile& file) { return file.hasWideColours(); });
    wanted.type = wide != files.end() ? ScalarType::UInt16 : ScalarType::UInt8;
    column.wideImage_ = wide != files.end() ? wide->path : std::string();
    wanted.components = 3;
  }
  else
  {
    wanted.type = typeOfNew(name, files.front().type);
    wanted.components = static_cast<std::uint8_t>(files.front().dataChannels());
  }
  column.attribute_ = wanted;
  const SourceDescription& description = source.description();
  const std::optional<std::size_t> present = description.schema.find(name);
  if (!present)
  {
    return column;
  }
  const Attribute& own = description.schema[*present];
  if (own.components != wanted.components || own.scale != 1.0 || own.offset != 0.0)
  {
    return makeError(Error::Kind::BadArgument,
      description.path + ": its attribute " + own.name + " has " + std::to_string(own.components) +
        " components" + (own.scale != 1.0 || own.offset != 0.0 ? " with a scale" : "") +
        ", the images have " + std::to_string(wanted.components) + "; take another name for them");
  }
  column.old_ = true;
  column.attribute_ = own;
  if (column.colour_)
  {
    const Result<bool> eight = own.type == ScalarType::UInt16
      ? haveEightBits(source, *present, resources)
      : Result<bool>(false);
    if (!eight)
    {
      return eight.error();
    }
    column.eightBitsInSixteen_ = *eight && wanted.type == ScalarType::UInt8;
    column.widens_ = *eight && wanted.type == ScalarType::UInt16;
    column.wideImage_ = column.widens_ ? column.wideImage_ : std::string();
  }
  return column;
}

void RasterColumn::widen(std::vector<std::byte>& values) const
{
  for (std::size_t at = 0; widens_ && at + 2 <= values.size(); at += 2)
  {
    const std::uint16_t wide = widenedColour(load<std::uint16_t>(values.data() + at));
    std::memcpy(values.data() + at, &wide, sizeof wide);
  }
}

RasterColumn::Outcome RasterColumn::store(
  const RasterFile& file, const std::byte* pixel, std::byte* to) const
{
  if (withoutData(file, pixel))
  {
    return Outcome::NoData;
  }
  return colour_ ? storeColour(file, pixel, to) : storeValues(file, pixel, to);
}

RasterColumn::Outcome RasterColumn::storeColour(
  const RasterFile& file, const std::byte* pixel, std::byte* to) const
{
  const bool wide = file.hasWideColours();
  for (std::size_t c = 0; c < 3; ++c)
  {
    const unsigned value = colourOf(file, pixel, c);
    if (attribute_.type == ScalarType::UInt8)
    {
      to[c] = static_cast<std::byte>(wide ? (value + 128) / 257 : value);
      continue;
    }
    const unsigned stored = wide || eightBitsInSixteen_ ? value : value * 257;
    const auto sixteen = static_cast<std::uint16_t>(stored);
    std::memcpy(to + 2 * c, &sixteen, sizeof sixteen);
  }
  return Outcome::Taken;
}

RasterColumn::Outcome RasterColumn::storeValues(
  const RasterFile& file, const std::byte* pixel, std::byte* to) const
{
  const std::size_t from = sizeOf(file.type);
  const std::size_t step = sizeOf(attribute_.type);
  std::array<std::byte, 16 * 8> values; // values of all components: all are stored, or none
  std::size_t component = 0;
  for (int channel = 0; channel < file.channels; ++channel)
  {
    if (channel == file.alphaChannel)
    {
      continue;
    }
    const std::byte* value = pixel + static_cast<std::size_t>(channel) * from;
    if (file.type == attribute_.type && file.spreadBits == 0)
    {
      std::memcpy(values.data() + component * step, value, step);
    }
    else if (!storeDouble(
               elementOf(file, value), attribute_.type, values.data() + component * step))
    {
      return Outcome::NotHeld;
    }
    ++component;
  }
  std::memcpy(to, values.data(), component * step);
  return Outcome::Taken;
}

} // namespace pointfront
