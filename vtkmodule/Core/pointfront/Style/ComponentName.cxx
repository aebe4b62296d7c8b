#include "pointfront/Style/ComponentName.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace pointfront
{
namespace
{

struct SplitName
{
  std::string_view attribute;
  int component = 0;
};

std::optional<SplitName> splitIndex(std::string_view name)
{
  const std::size_t open = name.rfind('[');
  if (name.empty() || name.back() != ']' || open == std::string_view::npos)
  {
    return std::nullopt;
  }
  SplitName split{ name.substr(0, open), 0 };
  const char* const end = name.data() + name.size() - 1;
  const auto [stop, failure] = std::from_chars(name.data() + open + 1, end, split.component);
  const bool whole = failure == std::errc() && stop == end && split.component >= 0;
  return whole ? std::optional<SplitName>(split) : std::nullopt;
}

std::optional<SplitName> splitLetter(std::string_view name)
{
  if (name.size() < 3 || name[name.size() - 2] != '.')
  {
    return std::nullopt;
  }
  const char letter = lowered(name.substr(name.size() - 1)).front();
  for (const std::string_view letters : { std::string_view("xyzw"), std::string_view("rgba") })
  {
    const std::size_t place = letters.find(letter);
    if (place != std::string_view::npos)
    {
      return SplitName{ name.substr(0, name.size() - 2), static_cast<int>(place) };
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> findAttribute(const AttributeSchema& schema, std::string_view name)
{
  const std::optional<std::size_t> column = schema.find(name);
  return column ? column : schema.find(withUnderscores(name));
}

} // namespace

std::optional<AttributeComponent> findComponent(
  const AttributeSchema& schema, std::string_view name)
{
  if (const auto column = findAttribute(schema, name))
  {
    return AttributeComponent{ static_cast<std::uint32_t>(*column), std::nullopt };
  }
  for (const std::optional<SplitName>& split : { splitIndex(name), splitLetter(name) })
  {
    const auto column = split ? findAttribute(schema, split->attribute) : std::nullopt;
    if (column && split->component < schema[*column].components)
    {
      return AttributeComponent{ static_cast<std::uint32_t>(*column), split->component };
    }
  }
  return std::nullopt;
}

std::string withUnderscores(std::string_view name)
{
  std::string result(name);
  std::replace(result.begin(), result.end(), '-', '_');
  return result;
}

} // namespace pointfront
