#include "JSONText.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace pointfront
{
namespace
{

using nlohmann::json;

/// Walks through a text that the parser found sound, and its values, side by side.
class ValueSearch
{
public:
  /// Stops at `wanted`, or, where that is null, at the first key that stands twice in an object.
  ValueSearch(std::string_view text, const json* wanted)
    : text_(text)
    , wanted_(wanted)
  {
  }

  /// The byte at which that value begins, or its key.
  std::optional<std::size_t> in(const json* value, int depth = 0)
  {
    constexpr int deepest = 256;
    skipBlanks();
    if (wanted_ && value == wanted_)
    {
      return at_;
    }
    if (depth > deepest || at_ >= text_.size())
    {
      at_ = text_.size();
      return {};
    }
    const char first = text_[at_];
    if (first == '{' || first == '[')
    {
      return inside(value, first == '{', depth);
    }
    if (first == '"')
    {
      string();
    }
    else
    {
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    }
    return {};
  }

private:
  void skipBlanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  /// Passes a string and gives it with its quotes.
  std::string_view string()
  {
    const std::size_t begin = at_;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
    {
      at_ += text_[at_] == '\\' ? 1 : 0;
    }
    at_ = std::min(at_ + 1, text_.size());
    return text_.substr(begin, at_ - begin);
  }

  /// Passes a key and its colon.
  std::string key()
  {
    const json name = json::parse(string(), nullptr, false);
    skipBlanks();
    ++at_;
    return name.is_string() ? name.get<std::string>() : std::string();
  }

  std::optional<std::size_t> inside(const json* parent, bool object, int depth)
  {
    std::set<std::string> keys;
    ++at_; // the bracket
    for (std::size_t index = 0;; ++index)
    {
      skipBlanks();
      if (at_ >= text_.size() || text_[at_] == ']' || text_[at_] == '}')
      {
        ++at_;
        return {};
      }
      const std::size_t begin = at_;
      const json* child = nullptr;
      bool twice = false;
      if (object)
      {
        const std::string name = key();
        twice = !keys.insert(name).second;
        child =
          parent && parent->is_object() && parent->contains(name) ? &parent->at(name) : nullptr;
      }
      else if (parent && parent->is_array() && index < parent->size())
      {
        child = &(*parent)[index];
      }
      if (wanted_ ? child == wanted_ : twice)
      {
        return begin;
      }
      if (const std::optional<std::size_t> found = in(child, depth + 1))
      {
        return found;
      }
      skipBlanks();
      at_ += at_ < text_.size() && text_[at_] == ',' ? 1 : 0;
    }
  }

  std::string_view text_;
  const json* wanted_;
  std::size_t at_ = 0;
};

/// "line 4: ", of a byte. Empty if the text has one line only.
std::string lineAt(std::string_view text, std::size_t at)
{
  const auto end = text.find_last_not_of(" \t\r\n");
  const std::string_view content = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
  if (content.find('\n') == std::string_view::npos)
  {
    return {};
  }
  const auto begin = content.begin();
  return "line " +
    std::to_string(1 + std::count(begin, begin + static_cast<std::ptrdiff_t>(at), '\n')) + ": ";
}

/// "line 3, column 12: what was expected", of a message of the parser.
std::string faultOf(const json::exception& failure)
{
  constexpr std::size_t most = 240;
  const std::string said = failure.what();
  const std::size_t line = said.find(" at line ");
  const std::size_t reason = said.find("] ");
  const std::size_t begin = line != std::string::npos ? line + 4
    : reason != std::string::npos                     ? reason + 2
                                                      : 0;
  return said.size() - begin > most ? said.substr(begin, most) + "..." : said.substr(begin);
}

} // namespace

Result<JSONText> JSONText::parse(std::string text, Keys keys)
{
  JSONText result;
  try
  {
    result.value_ = json::parse(text);
  }
  catch (const json::out_of_range&)
  {
    return makeError(Error::Kind::BadFormat,
      "a number in it is too large for double precision; write one below 1e308");
  }
  catch (const json::exception& failure)
  {
    return makeError(Error::Kind::BadFormat, "not JSON: " + faultOf(failure));
  }
  const std::optional<std::size_t> twice =
    keys == Keys::Unique ? ValueSearch(text, nullptr).in(&result.value_) : std::nullopt;
  if (twice)
  {
    const std::size_t colon = text.find(':', *twice);
    return makeError(Error::Kind::BadFormat,
      lineAt(text, *twice) + "the key " + text.substr(*twice, colon - *twice) +
        " stands twice in one object");
  }
  result.text_ = std::move(text);
  return result;
}

std::string JSONText::lineOf(const json& value) const
{
  const std::optional<std::size_t> at = ValueSearch(text_, &value).in(&value_);
  return at ? lineAt(text_, *at) : std::string();
}

} // namespace pointfront
