#include "ExtraBytesNames.h"

#include <set>
#include <string_view>

namespace pointfront
{
namespace
{
/// The longest beginning of at most `size` bytes that ends with a whole character of UTF-8.
std::string_view wholeCharacters(std::string_view text, std::size_t size)
{
  if (text.size() <= size)
  {
    return text;
  }
  constexpr unsigned continues = 0x80; // the two upper bits of all but the first byte
  constexpr unsigned upperBits = 0xc0;
  while (size > 0 && (static_cast<unsigned char>(text[size]) & upperBits) == continues)
  {
    --size;
  }
  return text.substr(0, size);
}

/// An index at the end of a name, "[12]", or nothing.
std::string_view indexOf(std::string_view name)
{
  const std::size_t open = name.rfind('[');
  if (open == std::string_view::npos || name.back() != ']' || open + 2 >= name.size())
  {
    return {};
  }
  for (std::size_t i = open + 1; i + 1 < name.size(); ++i)
  {
    if (name[i] < '0' || name[i] > '9')
    {
      return {};
    }
  }
  return name.substr(open);
}

/// A name with `mark` behind it, before its index.
std::string shortened(std::string_view name, const std::string& mark)
{
  std::string end = mark;
  end += indexOf(name);
  name.remove_suffix(indexOf(name).size());
  if (end.size() >= lasExtraBytesName)
  {
    return std::string(wholeCharacters(end, lasExtraBytesName));
  }
  return std::string(wholeCharacters(name, lasExtraBytesName - end.size())) + end;
}
} // namespace

std::vector<std::string> shortenExtraBytesNames(
  const AttributeSchema& fields, std::vector<Attribute>& extra)
{
  std::set<std::string> taken;
  for (std::size_t c = 0; c < fields.size(); ++c)
  {
    taken.insert(fields[c].name);
  }
  std::vector<Attribute*> changing;
  for (Attribute& attribute : extra)
  {
    if (attribute.name.size() > lasExtraBytesName || !taken.insert(attribute.name).second)
    {
      changing.push_back(&attribute);
    }
  }
  std::vector<std::string> changes;
  for (Attribute* const attribute : changing)
  {
    const bool tooLong = attribute->name.size() > lasExtraBytesName;
    std::string name = shortened(attribute->name, "");
    for (int copy = 2; !taken.insert(name).second; ++copy)
    {
      name = shortened(attribute->name, "_" + std::to_string(copy));
    }
    changes.push_back("The attribute '" + attribute->name + "' is written as '" + name +
      "': " + (tooLong ? "LAS has 32 bytes for a name." : "another one has its name."));
    attribute->name = name;
  }
  return changes;
}

} // namespace pointfront
