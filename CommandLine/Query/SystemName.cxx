#include "SystemName.h"

#include "pointfront/Base/LetterCase.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{
namespace
{

/// One keyword with what stands in its brackets.
struct Element
{
  std::string keyword; ///< upper case
  std::vector<std::string> words; ///< quoted texts and numbers, without their quotes
  std::vector<Element> children;
};

/// Reads elements one after the other; nothing where the text is none.
class BracketReader
{
public:
  explicit BracketReader(const std::string& text)
    : text_(text)
  {
  }

  std::optional<Element> element(int depth = 0)
  {
    Element found;
    skip();
    while (at_ < text_.size() && (isAsciiLetterOrDigit(text_[at_]) || text_[at_] == '_'))
    {
      found.keyword += text_[at_++];
    }
    found.keyword = capitals(found.keyword);
    skip();
    const bool opens = at_ < text_.size() && (text_[at_] == '[' || text_[at_] == '(');
    if (found.keyword.empty() || !opens || depth > deepest)
    {
      return std::nullopt;
    }
    ++at_;
    for (skip(); at_ < text_.size() && text_[at_] != ']' && text_[at_] != ')'; skip())
    {
      if (!item(found, depth))
      {
        return std::nullopt;
      }
    }
    const bool closed = at_ < text_.size();
    ++at_;
    return closed ? std::optional<Element>(std::move(found)) : std::nullopt;
  }

private:
  static constexpr int deepest = 32;

  void skip()
  {
    while (at_ < text_.size() && (isAsciiSpace(text_[at_]) || text_[at_] == ','))
    {
      ++at_;
    }
  }

  bool item(Element& parent, int depth)
  {
    if (at_ >= text_.size())
    {
      return false;
    }
    if (text_[at_] == '"')
    {
      const std::size_t end = text_.find('"', at_ + 1);
      if (end == std::string::npos)
      {
        return false;
      }
      parent.words.push_back(text_.substr(at_ + 1, end - at_ - 1));
      at_ = end + 1;
      return true;
    }
    const std::size_t end = text_.find_first_of("[](),", at_);
    if (end == std::string::npos)
    {
      return false;
    }
    if (text_[end] == '[' || text_[end] == '(')
    {
      std::optional<Element> child = element(depth + 1);
      child ? parent.children.push_back(std::move(*child)) : void();
      return child.has_value();
    }
    parent.words.push_back(text_.substr(at_, end - at_));
    at_ = end;
    return true;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

std::string codeOf(const Element& system)
{
  for (const Element& child : system.children)
  {
    if ((child.keyword == "ID" || child.keyword == "AUTHORITY") && child.words.size() >= 2)
    {
      return child.words[0] + ":" + child.words[1];
    }
  }
  if (system.keyword != "COMPD_CS" && system.keyword != "COMPOUNDCRS")
  {
    return "";
  }
  std::string codes;
  for (const Element& child : system.children)
  {
    const std::string code = codeOf(child);
    codes += code.empty() || codes.empty() ? code : " + " + code;
  }
  return codes;
}

} // namespace

std::string systemName(const std::string& wkt)
{
  const std::optional<Element> system = BracketReader(wkt).element();
  if (!system || system->words.empty())
  {
    return wkt;
  }
  const std::string code = codeOf(*system);
  const std::string& name = system->words.front();
  return code.empty() ? name : name.empty() ? code : code + " (" + name + ")";
}

std::string systemName(const GeoKeys& keys)
{
  const auto named = [&keys](GeoKeys::Key key)
  {
    const std::uint16_t code = keys.code(key).value_or(0);
    return code != 0 && code != GeoKeys::userDefined ? "EPSG:" + std::to_string(code) : "";
  };
  const bool projected = keys.code(GeoKeys::ProjectedSystem).has_value();
  std::string codes = named(projected ? GeoKeys::ProjectedSystem : GeoKeys::GeodeticSystem);
  const std::string heights = named(GeoKeys::VerticalSystem);
  codes += codes.empty() || heights.empty() ? "" : " + " + heights;
  const std::string own = keys.text(GeoKeys::ProjectedCitation);
  const std::string name = own.empty() ? keys.text(GeoKeys::Citation) : own;
  if (codes.empty())
  {
    return name.empty() ? "GeoTIFF keys without a code" : name + " (GeoTIFF keys without a code)";
  }
  return name.empty() ? codes : codes + " (" + name + ")";
}

} // namespace pointfront
