#include "PLYHeader.h"

#include "pointfront/Table/HeaderLines.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace pointfront
{
namespace
{
constexpr std::size_t mostElements = 256;
constexpr std::size_t mostProperties = 1000; // properties of one element

struct TypeName
{
  std::string_view name;
  ScalarType type;
};
constexpr std::array<TypeName, 16> typeNames{ { { "char", ScalarType::Int8 },
  { "int8", ScalarType::Int8 }, { "uchar", ScalarType::UInt8 }, { "uint8", ScalarType::UInt8 },
  { "short", ScalarType::Int16 }, { "int16", ScalarType::Int16 }, { "ushort", ScalarType::UInt16 },
  { "uint16", ScalarType::UInt16 }, { "int", ScalarType::Int32 }, { "int32", ScalarType::Int32 },
  { "uint", ScalarType::UInt32 }, { "uint32", ScalarType::UInt32 },
  { "float", ScalarType::Float32 }, { "float32", ScalarType::Float32 },
  { "double", ScalarType::Float64 }, { "float64", ScalarType::Float64 } } };

std::optional<ScalarType> typeOf(std::string_view name)
{
  for (const TypeName& row : typeNames)
  {
    if (row.name == name)
    {
      return row.type;
    }
  }
  return std::nullopt;
}

using Words = HeaderLines::Words;

/// The lines of one header, one by one.
class HeaderReader
{
public:
  HeaderReader(std::string_view text, const std::string& path)
    : lines_(text, path)
  {
  }
  Result<PLYHeader> read();

private:
  Error fault(Error::Kind kind, const std::string& what) const { return lines_.fault(kind, what); }
  Result<void> take(const Words& words);
  Result<void> takeFormat(const Words& words);
  Result<void> takeElement(const Words& words);
  Result<void> takeProperty(const Words& words);

  HeaderLines lines_;
  bool formatSeen_ = false;
  PLYHeader header_;
};

Result<void> HeaderReader::takeFormat(const Words& words)
{
  if (words.size() < 2)
  {
    return fault(Error::Kind::BadFormat, "a format line without a format");
  }
  if (words[1] == "ascii")
  {
    header_.encoding = PLYEncoding::Ascii;
  }
  else if (words[1] == "binary_little_endian")
  {
    header_.encoding = PLYEncoding::LittleEndian;
  }
  else if (words[1] == "binary_big_endian")
  {
    header_.encoding = PLYEncoding::BigEndian;
  }
  else
  {
    return fault(Error::Kind::Unsupported,
      "the PLY format '" + std::string(words[1]) +
        "' is unknown: ascii, binary_little_endian or binary_big_endian are read");
  }
  formatSeen_ = true;
  return {};
}

Result<void> HeaderReader::takeElement(const Words& words)
{
  PLYElement element;
  if (words.size() < 3)
  {
    return fault(Error::Kind::BadFormat, "an element line needs a name and a count");
  }
  const std::string_view count = words[2];
  const auto read = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (read.ec != std::errc() || read.ptr != count.data() + count.size())
  {
    return fault(
      Error::Kind::BadFormat, "'" + std::string(count.substr(0, 40)) + "' is no count of elements");
  }
  if (header_.elements.size() >= mostElements)
  {
    return fault(
      Error::Kind::Unsupported, "more than " + std::to_string(mostElements) + " kinds of elements");
  }
  element.name = std::string(words[1]);
  header_.elements.push_back(std::move(element));
  return {};
}

Result<void> HeaderReader::takeProperty(const Words& words)
{
  if (header_.elements.empty())
  {
    return fault(Error::Kind::BadFormat, "a property before the first element");
  }
  PLYElement& element = header_.elements.back();
  const bool list = words.size() > 1 && words[1] == "list";
  const std::size_t typeAt = list ? 3 : 1;
  if (words.size() < typeAt + 2)
  {
    return fault(Error::Kind::BadFormat, "a property line needs a type and a name");
  }
  PLYProperty property;
  const auto type = typeOf(words[typeAt]);
  const auto countType = list ? typeOf(words[2]) : std::optional<ScalarType>(ScalarType::UInt8);
  if (!type || !countType)
  {
    return fault(Error::Kind::Unsupported,
      "'" + std::string(words[type ? 2 : typeAt].substr(0, 40)) + "' is no type of PLY");
  }
  if (*countType == ScalarType::Float32 || *countType == ScalarType::Float64)
  {
    return fault(Error::Kind::BadFormat, "the count of a list is an integer, not a float");
  }
  if (element.properties.size() >= mostProperties)
  {
    return fault(Error::Kind::Unsupported,
      "more than " + std::to_string(mostProperties) + " properties of one element");
  }
  property.name = std::string(words[typeAt + 1]);
  property.type = *type;
  if (list)
  {
    property.listCount = *countType;
  }
  element.properties.push_back(std::move(property));
  return {};
}

Result<void> HeaderReader::take(const Words& words)
{
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info")
  {
    return {};
  }
  if (words[0] == "format")
  {
    return takeFormat(words);
  }
  if (words[0] == "element")
  {
    return takeElement(words);
  }
  if (words[0] == "property")
  {
    return takeProperty(words);
  }
  return fault(Error::Kind::BadFormat,
    "'" + std::string(words[0].substr(0, 40)) + "' is no keyword of a PLY header");
}

Result<PLYHeader> HeaderReader::read()
{
  const Words signature = lines_.next() ? lines_.words() : Words{};
  if (signature != Words{ "ply" })
  {
    return makeError(
      Error::Kind::BadFormat, lines_.path() + ": not a PLY file: its first line is not 'ply'");
  }
  while (lines_.next())
  {
    const Words words = lines_.words();
    if (words == Words{ "end_header" })
    {
      if (!formatSeen_)
      {
        return fault(Error::Kind::BadFormat, "the header has no format line");
      }
      header_.lines = lines_.number();
      header_.bodyOffset = lines_.behind();
      return std::move(header_);
    }
    if (Result<void> taken = take(words); !taken)
    {
      return taken.error();
    }
  }
  return makeError(Error::Kind::Truncated,
    lines_.path() + ": the PLY header does not end (no 'end_header' in the first " +
      std::to_string(lines_.size()) + " bytes); get a whole copy");
}
} // namespace

bool PLYElement::hasList() const
{
  return std::any_of(properties.begin(), properties.end(),
    [](const PLYProperty& property) { return property.listCount.has_value(); });
}

std::size_t PLYElement::rowBytes() const
{
  std::size_t bytes = 0;
  for (const PLYProperty& property : properties)
  {
    bytes += sizeOf(property.listCount ? *property.listCount : property.type);
  }
  return bytes;
}

Result<PLYHeader> PLYHeader::parse(std::string_view text, const std::string& path)
{
  return HeaderReader(text, path).read();
}

} // namespace pointfront
