#include "pointfront/Style/FilterExpression.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Style/ComponentName.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

namespace pointfront
{
namespace
{

bool isSpace(char c)
{
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool isExponent(char c)
{
  return c == 'e' || c == 'E';
}

/// Doubles from here on are whole numbers.
constexpr double leastWithoutFraction = 4503599627370496.0;

bool isWord(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Reads the text from left to right; the first thing that is wrong stops it.
class FilterParser
{
public:
  explicit FilterParser(std::string_view text)
    : text_(text)
  {
  }

  Result<std::vector<FilterTerm>> parse()
  {
    std::vector<FilterTerm> terms;
    skipSpace();
    if (atEnd())
    {
      return terms;
    }
    while (true)
    {
      FilterTerm term;
      readTerm(term);
      terms.push_back(std::move(term));
      if (!failure_.empty() || !more())
      {
        break;
      }
    }
    return failure_.empty() ? Result<std::vector<FilterTerm>>(std::move(terms))
                            : makeError(Error::Kind::BadArgument, failure_);
  }

private:
  bool atEnd() const { return at_ >= text_.size(); }
  char next() const { return atEnd() ? '\0' : text_[at_]; }

  void skipSpace()
  {
    while (!atEnd() && isSpace(text_[at_]))
    {
      ++at_;
    }
  }

  void fail(const std::string& expected) { fail(expected, at_); }

  void fail(const std::string& expected, std::size_t at)
  {
    if (failure_.empty())
    {
      const std::string_view rest = text_.substr(std::min(at, text_.size()));
      const std::string found =
        rest.empty() ? "the end" : "'" + std::string(rest.substr(0, 16)) + "'";
      failure_ = "'" + std::string(text_) + "', character " + std::to_string(at + 1) + ": " +
        expected + ", not " + found;
    }
  }

  /// The symbol, with spaces before it.
  bool take(std::string_view symbol)
  {
    skipSpace();
    if (text_.substr(at_, symbol.size()) != symbol)
    {
      return false;
    }
    at_ += symbol.size();
    return true;
  }

  bool takeWord(std::string_view word)
  {
    skipSpace();
    const std::size_t end = at_ + word.size();
    const bool whole = end >= text_.size() || !isWord(text_[end]);
    if (!whole || !sameWithoutCase(text_.substr(at_, word.size()), word))
    {
      return false;
    }
    at_ = end;
    return true;
  }

  bool more()
  {
    skipSpace();
    if (atEnd())
    {
      return false;
    }
    if (!takeWord("and"))
    {
      fail("expected 'and' or the end");
      return false;
    }
    return true;
  }

  void readName(FilterTerm& term)
  {
    skipSpace();
    term.position = at_;
    if (take("\""))
    {
      const std::size_t end = text_.find('"', at_);
      if (end == std::string_view::npos)
      {
        fail("expected a name and a closing \"", term.position);
        return;
      }
      term.name = text_.substr(at_, end - at_);
      at_ = end + 1;
    }
    else
    {
      const std::size_t begin = at_;
      while (!atEnd() && !isSpace(next()) &&
        std::string_view("=!<>(){},\"").find(next()) == std::string_view::npos)
      {
        ++at_;
      }
      term.name = text_.substr(begin, at_ - begin);
      if (sameWithoutCase(term.name, "and") || sameWithoutCase(term.name, "in"))
      {
        fail("expected the name of an attribute, or \"" + term.name + "\" in quotes", begin);
      }
    }
    if (term.name.empty())
    {
      fail("expected the name of an attribute", term.position);
    }
  }

  /// Reads a number without point and exponent, exactly, if it has 64 bits at most.
  static std::optional<ConditionNumber> wholeNumber(const char* begin, const char* end)
  {
    std::int64_t negative = 0;
    std::uint64_t positive = 0;
    const auto all = [end](const std::from_chars_result& read)
    { return read.ec == std::errc() && read.ptr == end; };
    if (all(std::from_chars(begin, end, positive)))
    {
      return static_cast<ConditionNumber>(positive);
    }
    if (all(std::from_chars(begin, end, negative)))
    {
      return static_cast<ConditionNumber>(negative);
    }
    return std::nullopt;
  }

  ConditionNumber readNumber()
  {
    skipSpace();
    const std::size_t begin = at_;
    if (next() == '+')
    {
      ++at_;
    }
    double number = 0.0;
    const char* const from = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const auto [stop, failure] = std::from_chars(from, end, number);
    if (failure != std::errc() || std::isnan(number) || (stop != end && isWord(*stop)))
    {
      fail("expected a number", begin);
      return 0.0;
    }
    at_ = static_cast<std::size_t>(stop - text_.data());
    const char* whole = stop;
    if (std::abs(number) >= leastWithoutFraction && std::none_of(from, stop, isExponent))
    {
      whole = std::find(from, stop, '.');
      if (std::any_of(whole, stop, [](char c) { return c >= '1' && c <= '9'; }))
      {
        fail("expected a whole number, as a double of that size has no fraction", begin);
      }
    }
    return wholeNumber(from, whole).value_or(number);
  }

  void readRange(AttributeCondition& condition, bool lowOpen)
  {
    const std::size_t begin = at_;
    condition.lowOpen = lowOpen;
    condition.range[0] = readNumber();
    if (!take(","))
    {
      fail("expected ',' and the other end of the range");
    }
    condition.range[1] = readNumber();
    condition.highOpen = take(")");
    if (!condition.highOpen && !take("]"))
    {
      fail("expected ']' or ')'");
    }
    const bool empty = condition.lowOpen || condition.highOpen
      ? !(condition.range[0] < condition.range[1])
      : !(condition.range[0] <= condition.range[1]);
    if (empty)
    {
      fail("expected a range that holds a number", begin);
    }
  }

  void readSet(AttributeCondition& condition)
  {
    do
    {
      condition.values.push_back(readNumber());
    } while (failure_.empty() && take(","));
    if (!take("}"))
    {
      fail("expected ',' or '}'");
    }
    std::sort(condition.values.begin(), condition.values.end());
    condition.values.erase(
      std::unique(condition.values.begin(), condition.values.end()), condition.values.end());
  }

  void readMembership(AttributeCondition& condition)
  {
    if (take("{"))
    {
      readSet(condition);
    }
    else if (take("["))
    {
      readRange(condition, false);
    }
    else if (take("("))
    {
      readRange(condition, true);
    }
    else
    {
      fail("expected [low, high], (low, high) or {value, value}");
    }
  }

  void readComparison(AttributeCondition& condition)
  {
    if (take("==") || take("!="))
    {
      condition.inverted = text_[at_ - 2] == '!';
      condition.values = { readNumber() };
    }
    else if (take("<=") || take("<"))
    {
      condition.highOpen = text_[at_ - 1] == '<';
      condition.range[1] = readNumber();
    }
    else if (take(">=") || take(">"))
    {
      condition.lowOpen = text_[at_ - 1] == '>';
      condition.range[0] = readNumber();
    }
    else
    {
      fail("expected 'in', ==, !=, <, <=, > or >=");
    }
  }

  void readTerm(FilterTerm& term)
  {
    readName(term);
    if (takeWord("not"))
    {
      term.passing.inverted = true;
      if (!takeWord("in"))
      {
        fail("expected 'in' after 'not'");
        return;
      }
      readMembership(term.passing);
    }
    else if (takeWord("in"))
    {
      readMembership(term.passing);
    }
    else
    {
      readComparison(term.passing);
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string failure_;
};

int axisOf(std::string_view name)
{
  constexpr std::string_view names[] = { "x", "y", "z", "elevation" };
  for (int axis = 0; axis < 4; ++axis)
  {
    if (sameWithoutCase(name, names[axis]))
    {
      return std::min(axis, 2);
    }
  }
  return -1;
}

/// Whether no store holds it, unless one has an attribute of that name.
bool isDerived(const StoreDescription& store, const std::string& name, const char* derived)
{
  return sameWithoutCase(withUnderscores(name), derived) && !findComponent(store.schema, name);
}

Error refusal(const FilterExpression& filter, const FilterTerm& term, const std::string& why)
{
  return makeError(Error::Kind::BadArgument,
    "'" + filter.text + "', character " + std::to_string(term.position + 1) + ": " + why);
}

} // namespace

Result<FilterExpression> FilterExpression::parse(std::string_view text)
{
  Result<std::vector<FilterTerm>> terms = FilterParser(text).parse();
  if (!terms)
  {
    return terms.error();
  }
  FilterExpression filter;
  filter.terms = std::move(*terms);
  filter.text = filter.empty() ? std::string() : std::string(text);
  return filter;
}

bool FilterExpression::wantsHeights(const StoreDescription& store) const
{
  return std::any_of(terms.begin(), terms.end(),
    [&store](const FilterTerm& term) { return isDerived(store, term.name, "global_height"); });
}

Result<PointFilter> FilterExpression::resolve(
  const StoreDescription& store, const std::shared_ptr<const ClassHeights>& heights) const
{
  PointFilter filter;
  for (const FilterTerm& term : terms)
  {
    AttributeCondition condition = term.passing;
    condition.heights = isDerived(store, term.name, "global_height") ? heights : nullptr;
    condition.absolute = isDerived(store, term.name, "horizontality");
    const std::optional<AttributeComponent> found =
      findComponent(store.schema, condition.absolute ? "normal.z" : term.name);
    const int axis = found ? -1 : condition.heights ? 2 : axisOf(term.name);
    if (!found && axis < 0)
    {
      return refusal(*this, term,
        store.path +
          (condition.absolute
              ? " has no attribute 'normal', which horizontality needs: build it with --normals pca"
              : " has no attribute '" + term.name + "' (info lists them)" +
                meantAttribute(store.schema, term.name)));
    }
    if (axis >= 0)
    {
      condition.axis = axis;
      condition.axisScale = store.grid.scale[axis];
      condition.axisOffset = store.grid.offset[axis];
      condition.heights == nullptr ? condition.takeAsWritten(nullptr) : void();
    }
    else
    {
      const Attribute& attribute = store.schema[found->column];
      if (attribute.components > 1 && !found->component)
      {
        return refusal(*this, term,
          "'" + term.name + "' has " + std::to_string(attribute.components) +
            " components: write one of them, " + term.name + "[0]");
      }
      condition.column = found->column;
      condition.component = found->component.value_or(0);
      condition.takeAsWritten(&attribute);
    }
    filter.conditions.push_back(std::move(condition));
  }
  return filter;
}

} // namespace pointfront
