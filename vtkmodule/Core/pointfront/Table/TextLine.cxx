#include "pointfront/Table/TextLine.h"

#include <cmath>

namespace pointfront
{
namespace
{
bool isBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

const char* skipBlanks(const char* p, const char* end)
{
  while (p != end && isBlank(*p))
  {
    ++p;
  }
  return p;
}

/// A line, cell by cell.
class CellReader
{
public:
  CellReader(const char* text, const char* end, const TextLayout& layout)
    : p_(skipBlanks(text, end))
    , end_(end)
    , separator_(layout.separator)
    , point_(layout.decimalPoint)
  {
  }

  /// True if a further cell begins here; an empty one between two separators is one.
  bool more() const { return p_ != end_; }
  bool number(DecimalNumber& number)
  {
    const char quote = p_ != end_ && (*p_ == '"' || *p_ == '\'') ? *p_ : '\0';
    const char* from = quote != '\0' ? p_ + 1 : p_;
    const char* behind = readDecimal(from, end_, point_, number);
    if (behind == from || (quote != '\0' && (behind == end_ || *behind != quote)))
    {
      return false;
    }
    p_ = behind + (quote != '\0' ? 1 : 0);
    return endCell();
  }
  void skip()
  {
    if (p_ != end_ && *p_ == '"') // quoted text may hold separators
    {
      const char* const open = p_++;
      while (p_ != end_ && (*p_ != '"' || (end_ - p_ > 1 && p_[1] == '"'))) // "" is one of its text
      {
        p_ += *p_ == '"' ? 2 : 1;
      }
      p_ = p_ == end_ ? open : p_ + 1;
    }
    while (p_ != end_ && (separator_ == ' ' ? !isBlank(*p_) : *p_ != separator_))
    {
      ++p_;
    }
    endCell();
  }

private:
  /// Goes to the next cell; false if the cell has not ended here.
  bool endCell()
  {
    const char* const cellEnd = p_;
    if (separator_ == '\t') // a blank, but one that counts
    {
      while (p_ != end_ && *p_ != '\t' && isBlank(*p_))
      {
        ++p_;
      }
    }
    else
    {
      p_ = skipBlanks(p_, end_);
    }
    if (p_ == end_)
    {
      return true;
    }
    if (separator_ == ' ')
    {
      return p_ != cellEnd;
    }
    if (*p_ != separator_)
    {
      return false;
    }
    ++p_;
    while (p_ != end_ && *p_ != separator_ && isBlank(*p_))
    {
      ++p_;
    }
    return true;
  }

  const char* p_;
  const char* end_;
  char separator_;
  char point_;
};

bool isCount(const DecimalNumber& number)
{
  constexpr double most = 1e15;
  return !number.pointSeen && number.value >= 0.0 && number.value <= most;
}

/// A list of a PLY file: its count, then as many cells.
bool skipList(CellReader& cells)
{
  DecimalNumber count;
  if (!cells.number(count) || !isCount(count))
  {
    return false;
  }
  for (double k = 0; k < count.value; ++k)
  {
    if (!cells.more())
    {
      return false;
    }
    cells.skip();
  }
  return true;
}
} // namespace

bool isBlankLine(const char* text, const char* end)
{
  return skipBlanks(text, end) == end;
}

bool isCommentLine(const char* text, const char* end)
{
  const char* p = skipBlanks(text, end);
  return p != end && (*p == '#' || *p == '%' || (*p == '/' && end - p > 1 && p[1] == '/'));
}

TextLine readLine(
  const char* text, const char* end, const TextLayout& layout, std::vector<DecimalNumber>& numbers)
{
  if (isBlankLine(text, end) || (layout.comments && isCommentLine(text, end)))
  {
    return TextLine::Nothing;
  }
  CellReader cells(text, end, layout);
  if (layout.countLines)
  {
    CellReader alone(text, end, layout);
    if (alone.number(numbers[0]) && !alone.more() && isCount(numbers[0]))
    {
      return TextLine::Count;
    }
  }
  for (const TextLayout::Cell& cell : layout.cells)
  {
    if (!cells.more())
    {
      return TextLine::Bad;
    }
    if (cell.list ? !skipList(cells) : cell.field && !cells.number(numbers[*cell.field]))
    {
      return TextLine::Bad;
    }
    if (!cell.list && !cell.field)
    {
      cells.skip();
    }
  }
  return TextLine::Row;
}

} // namespace pointfront
