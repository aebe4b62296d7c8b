#include "PCDHeader.h"

#include "pointfront/Table/DecimalNumber.h"
#include "pointfront/Table/HeaderLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace pointfront
{
namespace
{
constexpr std::size_t mostFields = 1000;
constexpr std::uint64_t mostElements = 1 << 20; // elements of a field, and of all fields of a point
constexpr std::uint64_t mostPoints = 1ull << 48;

using Words = HeaderLines::Words;

std::optional<std::uint64_t> countOf(std::string_view word, std::uint64_t most)
{
  std::uint64_t value = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = read.ec == std::errc() && read.ptr == word.data() + word.size();
  return whole && value <= most ? std::make_optional(value) : std::nullopt;
}

std::optional<ScalarType> typeOf(std::string_view type, std::uint64_t size)
{
  const std::int64_t bytes = size <= 8 ? static_cast<std::int64_t>(size) : 0;
  return type == "F"             ? floatTypeOf(bytes)
    : type == "I" || type == "U" ? integerTypeOf(bytes, type == "I")
                                 : std::nullopt;
}

/// The position among seven finite numbers: x y z, and a quaternion.
std::optional<glm::dvec3> viewpointOf(const Words& words)
{
  double values[7];
  for (std::size_t i = 0; i < 7; ++i)
  {
    if (words.size() != 7)
    {
      return std::nullopt;
    }
    const char* const end = words[i].data() + words[i].size();
    const auto read = std::from_chars(words[i].data(), end, values[i]);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(values[i]))
    {
      return std::nullopt;
    }
  }
  return glm::dvec3(values[0], values[1], values[2]);
}

class HeaderReader
{
public:
  HeaderReader(std::string_view text, const std::string& path)
    : lines_(text, path)
  {
  }
  Result<PCDHeader> read();

private:
  Error fault(Error::Kind kind, const std::string& what) const { return lines_.fault(kind, what); }
  Result<void> take(const Words& words);
  void takeOrigin(const Words& words);
  Result<void> takeData(const Words& words);
  Result<void> assembleFields();
  Result<void> checkCounts();

  HeaderLines lines_;
  PCDHeader header_;
  Words names_, sizes_, types_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
  bool dataSeen_ = false;
};

Result<void> HeaderReader::takeData(const Words& words)
{
  const std::string_view kind = words.size() > 1 ? words[1] : std::string_view();
  dataSeen_ = true;
  if (kind == "ascii")
  {
    header_.encoding = PCDEncoding::Ascii;
  }
  else if (kind == "binary")
  {
    header_.encoding = PCDEncoding::Binary;
  }
  else if (kind == "binary_compressed")
  {
    header_.encoding = PCDEncoding::BinaryCompressed;
  }
  else
  {
    return fault(Error::Kind::Unsupported,
      "DATA '" + std::string(kind.substr(0, 40)) +
        "' is unknown: ascii, binary or binary_compressed are read");
  }
  return {};
}

Result<void> HeaderReader::take(const Words& words)
{
  const Words values(words.begin() + 1, words.end());
  if (words[0] == "FIELDS" || words[0] == "COLUMNS")
  {
    names_ = values;
  }
  else if (words[0] == "SIZE")
  {
    sizes_ = values;
  }
  else if (words[0] == "TYPE")
  {
    types_ = values;
  }
  else if (words[0] == "COUNT")
  {
    counts_ = values;
  }
  else if (words[0] == "WIDTH" || words[0] == "HEIGHT" || words[0] == "POINTS")
  {
    const auto count = values.empty() ? std::nullopt : countOf(values[0], mostPoints);
    if (!count)
    {
      return fault(
        Error::Kind::BadFormat, std::string(words[0]) + " is no count that a file can hold");
    }
    (words[0] == "WIDTH" ? width_ : words[0] == "HEIGHT" ? height_ : points_) = count;
  }
  else if (words[0] == "DATA")
  {
    return takeData(words);
  }
  else if (words[0] == "VIEWPOINT")
  {
    header_.viewpoint = viewpointOf(values);
    header_.viewpointDamaged = !header_.viewpoint;
  }
  else if (words[0] != "VERSION")
  {
    return fault(Error::Kind::BadFormat,
      "'" + std::string(words[0].substr(0, 40)) + "' is no keyword of a PCD header");
  }
  return {};
}

Result<void> HeaderReader::assembleFields()
{
  const std::size_t n = names_.size();
  const bool counted = counts_.empty() || counts_.size() == n;
  if (n == 0 || sizes_.size() != n || types_.size() != n || !counted)
  {
    return makeError(Error::Kind::BadFormat,
      lines_.path() +
        ": FIELDS, SIZE, TYPE and COUNT of the PCD header do not name as many fields (" +
        std::to_string(n) + ", " + std::to_string(sizes_.size()) + ", " +
        std::to_string(types_.size()) + ", " + std::to_string(counts_.size()) + ")");
  }
  if (n > mostFields)
  {
    return makeError(Error::Kind::Unsupported,
      lines_.path() + ": more than " + std::to_string(mostFields) + " fields");
  }
  std::uint64_t elements = 0;
  for (std::size_t f = 0; f < n; ++f)
  {
    const auto size = countOf(sizes_[f], 8);
    const auto type = size ? typeOf(types_[f], *size) : std::nullopt;
    const auto count =
      counts_.empty() ? std::optional<std::uint64_t>(1) : countOf(counts_[f], mostElements);
    if (!type || !count || *count == 0)
    {
      return makeError(Error::Kind::BadFormat,
        lines_.path() + ": field '" + std::string(names_[f].substr(0, 40)) +
          "' of the PCD header has no type that there is (TYPE I or U with SIZE 1, 2, 4, 8; F "
          "with 4, 8; COUNT 1 or more)");
    }
    elements += *count;
    if (elements > mostElements)
    {
      return makeError(Error::Kind::Unsupported,
        lines_.path() + ": a point of more than " + std::to_string(mostElements) + " numbers");
    }
    header_.fields.push_back({ std::string(names_[f]), *type, static_cast<std::size_t>(*count) });
  }
  return {};
}

Result<void> HeaderReader::checkCounts()
{
  if (!points_ && !width_)
  {
    return makeError(Error::Kind::BadFormat,
      lines_.path() + ": the PCD header says neither POINTS nor WIDTH: how many points there are");
  }
  const std::uint64_t height = height_.value_or(1);
  const std::uint64_t width = width_.value_or(points_.value_or(0));
  const bool overflow = height > 0 && width > mostPoints / height;
  header_.points = points_.value_or(overflow ? 0 : width * height);
  if (overflow || width * height != header_.points)
  {
    return makeError(Error::Kind::BadFormat,
      lines_.path() + ": the PCD header contradicts itself: WIDTH " + std::to_string(width) +
        " times HEIGHT " + std::to_string(height) + " is not POINTS " +
        std::to_string(header_.points));
  }
  return {};
}

/// A comment that is none of ours says nothing.
void HeaderReader::takeOrigin(const Words& words)
{
  if (words.size() != 5 || words[0] != "#" || words[1] != "ORIGIN")
  {
    return;
  }
  glm::dvec3 origin(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::string_view word = words[static_cast<std::size_t>(axis) + 2];
    DecimalNumber number;
    const char* const end = word.data() + word.size();
    if (readDecimal(word.data(), end, '.', number) != end || !std::isfinite(number.value))
    {
      return;
    }
    origin[axis] = number.value;
  }
  header_.origin = origin;
}

Result<PCDHeader> HeaderReader::read()
{
  while (!dataSeen_ && lines_.next())
  {
    const Words words = lines_.words();
    if (words.empty() || words[0].front() == '#')
    {
      takeOrigin(words);
      continue;
    }
    if (Result<void> taken = take(words); !taken)
    {
      return taken.error();
    }
  }
  if (!dataSeen_)
  {
    return makeError(Error::Kind::Truncated,
      lines_.path() + ": the PCD header does not end (no DATA line in the first " +
        std::to_string(lines_.size()) + " bytes); get a whole copy");
  }
  header_.lines = lines_.number();
  header_.dataOffset = lines_.behind();
  if (Result<void> fields = assembleFields(); !fields)
  {
    return fields.error();
  }
  if (Result<void> counts = checkCounts(); !counts)
  {
    return counts.error();
  }
  return std::move(header_);
}
} // namespace

std::size_t PCDHeader::pointBytes() const
{
  std::size_t bytes = 0;
  for (const PCDField& field : fields)
  {
    bytes += field.bytes();
  }
  return bytes;
}

Result<PCDHeader> PCDHeader::parse(std::string_view text, const std::string& path)
{
  return HeaderReader(text, path).read();
}

} // namespace pointfront
