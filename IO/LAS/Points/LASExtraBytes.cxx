#include "LASExtraBytes.h"

#include "pointfront/Base/PrintableText.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointfront
{
namespace
{
/// Offsets in a descriptor.
constexpr std::size_t typeAt = 2;
constexpr std::size_t optionsAt = 3;
constexpr std::size_t nameAt = 4;
constexpr std::size_t scaleAt = 112;
constexpr std::size_t offsetAt = 136;
constexpr std::size_t descriptionAt = 160;
constexpr std::size_t textBytes = 32;

constexpr unsigned hasScale = 8;
constexpr unsigned hasOffset = 16;

constexpr std::size_t mostComponents = 16; // components of an Attribute

/// Data types 1 to 10; 11 to 20 are pairs of them, 21 to 30 triples.
constexpr std::array<ScalarType, 10> scalarTypes{ ScalarType::UInt8, ScalarType::Int8,
  ScalarType::UInt16, ScalarType::Int16, ScalarType::UInt32, ScalarType::Int32, ScalarType::UInt64,
  ScalarType::Int64, ScalarType::Float32, ScalarType::Float64 };

/// The content of one descriptor.
struct Descriptor
{
  std::string name;
  std::string description;
  unsigned type = 0;
  std::size_t components = 1;
  std::size_t undocumentedBytes = 0; ///< type 0 only
  std::array<double, 3> scale{ 1.0, 1.0, 1.0 };
  std::array<double, 3> offset{ 0.0, 0.0, 0.0 };

  ScalarType scalar() const { return scalarTypes[(type - 1) % 10]; }
  std::size_t bytes() const
  {
    return type == 0 ? undocumentedBytes : sizeOf(scalar()) * components;
  }
};

Descriptor parseDescriptor(const std::byte* from)
{
  Descriptor d;
  d.type = loadNumber<std::uint8_t>(from + typeAt);
  const unsigned options = loadNumber<std::uint8_t>(from + optionsAt);
  d.name = printableText(loadText(from + nameAt, textBytes));
  d.description = printableText(loadText(from + descriptionAt, textBytes));
  if (d.type == 0)
  {
    d.undocumentedBytes = options; // the standard's double use of this field
    return d;
  }
  d.components = (d.type - 1) / 10 + 1;
  for (std::size_t k = 0; k < std::min<std::size_t>(d.components, 3); ++k)
  {
    const auto scale = loadNumber<double>(from + scaleAt + 8 * k);
    const auto offset = loadNumber<double>(from + offsetAt + 8 * k);
    const bool scaled = (options & hasScale) != 0 && std::isfinite(scale) && scale != 0.0;
    d.scale[k] = scaled ? scale : 1.0;
    d.offset[k] = (options & hasOffset) != 0 && std::isfinite(offset) ? offset : 0.0;
  }
  return d;
}

void addUndocumented(const std::string& name, std::size_t bytes, std::vector<Attribute>& to)
{
  for (; bytes > 0; bytes -= std::min(bytes, mostComponents))
  {
    to.push_back({ name.empty() ? "extra" : name, ScalarType::UInt8,
      static_cast<std::uint8_t>(std::min(bytes, mostComponents)) });
  }
}

void addDocumented(const Descriptor& d, std::vector<Attribute>& to)
{
  const std::string name = d.name.empty() ? "extra" : d.name;
  bool alike = true;
  for (std::size_t k = 1; k < d.components; ++k)
  {
    alike = alike && d.scale[k] == d.scale[0] && d.offset[k] == d.offset[0];
  }
  if (alike)
  {
    to.push_back({ name, d.scalar(), static_cast<std::uint8_t>(d.components), d.scale[0],
      d.offset[0], d.description });
    return;
  }
  for (std::size_t k = 0; k < d.components; ++k)
  {
    to.push_back({ name + "[" + std::to_string(k) + "]", d.scalar(), 1, d.scale[k], d.offset[k],
      d.description });
  }
}

std::vector<const std::byte*> descriptorsIn(const std::vector<ByteSpan>& payloads)
{
  std::vector<const std::byte*> all;
  for (const ByteSpan& payload : payloads)
  {
    for (std::size_t at = 0; at + lasExtraBytesDescriptor <= payload.size;
         at += lasExtraBytesDescriptor)
    {
      all.push_back(payload.data + at);
    }
  }
  return all;
}

/// The data type number of an attribute, 0 for bytes without meaning of their own.
unsigned typeOf(const Attribute& attribute)
{
  if (attribute.components > 3)
  {
    return 0;
  }
  const auto* place = std::find(scalarTypes.begin(), scalarTypes.end(), attribute.type);
  return static_cast<unsigned>(place - scalarTypes.begin()) + 1 + 10u * (attribute.components - 1u);
}

bool saysTheSame(const std::byte* descriptor, const Attribute& attribute)
{
  std::vector<Attribute> parsed;
  const Descriptor d = parseDescriptor(descriptor);
  if (d.type == 0 || d.type > 30)
  {
    return false;
  }
  addDocumented(d, parsed);
  return parsed.size() == 1 && parsed[0] == attribute;
}

void composeDescriptor(const Attribute& attribute, std::byte* to)
{
  const unsigned type = typeOf(attribute);
  unsigned options = attribute.scale != 1.0 ? hasScale : 0;
  options |= attribute.offset != 0.0 ? hasOffset : 0;
  storeText(to + nameAt, textBytes, attribute.name);
  storeText(to + descriptionAt, textBytes, attribute.description);
  storeNumber(to + typeAt, static_cast<std::uint8_t>(type));
  if (type == 0)
  {
    storeNumber(to + optionsAt, static_cast<std::uint8_t>(attribute.bytes()));
    return;
  }
  storeNumber(to + optionsAt, static_cast<std::uint8_t>(options));
  for (std::size_t k = 0; k < attribute.components; ++k)
  {
    storeNumber(to + scaleAt + 8 * k, (options & hasScale) != 0 ? attribute.scale : 0.0);
    storeNumber(to + offsetAt + 8 * k, (options & hasOffset) != 0 ? attribute.offset : 0.0);
  }
}
} // namespace

std::vector<Attribute> parseExtraBytes(
  const std::vector<ByteSpan>& payloads, std::size_t byteCount, std::vector<std::string>& warnings)
{
  std::vector<Attribute> attributes;
  const std::vector<const std::byte*> descriptors = descriptorsIn(payloads);
  std::size_t used = 0;
  for (std::size_t i = 0; i < descriptors.size(); ++i)
  {
    const Descriptor d = parseDescriptor(descriptors[i]);
    if (d.type > 30 || d.bytes() > byteCount - used)
    {
      warnings.push_back("Extra bytes descriptor " + std::to_string(i + 1) + " of " +
        std::to_string(descriptors.size()) + " (\"" + d.name + "\") " +
        (d.type > 30 ? "has the unknown data type " + std::to_string(d.type)
                     : "needs more bytes than the " + std::to_string(byteCount - used) +
              " left in a point record") +
        ": the names of " + std::to_string(descriptors.size() - i) + " attributes were lost.");
      break;
    }
    d.type == 0 ? addUndocumented(d.name, d.bytes(), attributes) : addDocumented(d, attributes);
    used += d.bytes();
  }
  addUndocumented("", byteCount - used, attributes);
  return attributes;
}

std::vector<std::byte> composeExtraBytes(
  const std::vector<Attribute>& attributes, const std::vector<ByteSpan>& originals)
{
  const std::vector<const std::byte*> known = descriptorsIn(originals);
  std::vector<std::byte> payload(attributes.size() * lasExtraBytesDescriptor);
  for (std::size_t i = 0; i < attributes.size(); ++i)
  {
    std::byte* to = payload.data() + i * lasExtraBytesDescriptor;
    const auto original = std::find_if(known.begin(), known.end(),
      [&](const std::byte* descriptor) { return saysTheSame(descriptor, attributes[i]); });
    if (original != known.end())
    {
      std::memcpy(to, *original, lasExtraBytesDescriptor);
      continue;
    }
    composeDescriptor(attributes[i], to);
  }
  return payload;
}

} // namespace pointfront
