#include "TextCells.h"

#include "pointfront/Table/DecimalNumber.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::string_view blanks = " \t\r\v\f";

bool isQuoted(std::string_view cell)
{
  return cell.size() > 1 && (cell.front() == '"' || cell.front() == '\'') &&
    cell.back() == cell.front();
}

std::string_view withoutBlanks(std::string_view cell)
{
  const std::size_t begin = cell.find_first_not_of(blanks);
  return begin == std::string_view::npos
    ? std::string_view()
    : cell.substr(begin, cell.find_last_not_of(blanks) - begin + 1);
}

/// The mark that closes the quoted text which begins at `open`; two in a row are one of its text.
std::size_t closingQuote(std::string_view line, std::size_t open)
{
  std::size_t close = line.find('"', open + 1);
  while (close != std::string_view::npos && close + 1 < line.size() && line[close + 1] == '"')
  {
    close = line.find('"', close + 2);
  }
  return close;
}

/// The cells of a line with the quotes around them.
std::vector<std::string_view> writtenCells(std::string_view line, char separator)
{
  std::vector<std::string_view> cells;
  line = line.substr(0, line.find_last_not_of(blanks) + 1);
  for (std::size_t begin = line.find_first_not_of(blanks); begin < line.size();)
  {
    std::size_t from = begin;
    if (line[begin] == '"') // quoted text may hold separators
    {
      const std::size_t close = closingQuote(line, begin);
      from = close == std::string_view::npos ? begin : close;
    }
    const std::size_t found =
      separator == ' ' ? line.find_first_of(blanks, from) : line.find(separator, from);
    const std::size_t end = std::min(found, line.size());
    cells.push_back(withoutBlanks(line.substr(begin, end - begin)));
    begin = separator == ' ' ? line.find_first_not_of(blanks, end) : end + 1;
  }
  return cells;
}
} // namespace

std::vector<std::string_view> cellsOf(std::string_view line, char separator)
{
  std::vector<std::string_view> cells = writtenCells(line, separator);
  for (std::string_view& cell : cells)
  {
    cell = isQuoted(cell) ? cell.substr(1, cell.size() - 2) : cell;
  }
  return cells;
}

std::vector<std::string> textsOf(std::string_view line, char separator)
{
  std::vector<std::string> texts;
  for (const std::string_view cell : writtenCells(line, separator))
  {
    const bool quoted = isQuoted(cell);
    std::string& text = texts.emplace_back(quoted ? cell.substr(1, cell.size() - 2) : cell);
    const std::string two(2, quoted ? cell.front() : '\0');
    for (std::size_t at = text.find(two); quoted && at != std::string::npos;
         at = text.find(two, at + 1))
    {
      text.erase(at, 1);
    }
  }
  return texts;
}

bool isNumber(std::string_view cell, char decimalPoint)
{
  DecimalNumber number;
  const char* const end = cell.data() + cell.size();
  return !cell.empty() && readDecimal(cell.data(), end, decimalPoint, number) == end;
}

char separatorOf(std::string_view line)
{
  for (const char separator : { ';', ',', '\t' })
  {
    if (line.find(separator) != std::string_view::npos)
    {
      return separator;
    }
  }
  return ' ';
}

std::string_view lineAt(std::string_view text, std::size_t begin, char lineEnd, std::size_t& next)
{
  const std::size_t end = std::min(text.find(lineEnd, begin), text.size());
  next = std::min(end + 1, text.size());
  return text.substr(begin, end - begin);
}

} // namespace pointfront
