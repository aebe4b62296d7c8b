#include "TextCells.h"

#include "pointfront/Table/DecimalNumber.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view cell)
{
  const std::size_t begin = cell.find_first_not_of(blanks);
  if (begin == std::string_view::npos)
  {
    return {};
  }
  cell = cell.substr(begin, cell.find_last_not_of(blanks) - begin + 1);
  const bool quoted =
    cell.size() > 1 && (cell.front() == '"' || cell.front() == '\'') && cell.back() == cell.front();
  return quoted ? cell.substr(1, cell.size() - 2) : cell;
}
} // namespace

std::vector<std::string_view> cellsOf(std::string_view line, char separator)
{
  std::vector<std::string_view> cells;
  line = line.substr(0, line.find_last_not_of(blanks) + 1);
  for (std::size_t begin = line.find_first_not_of(blanks); begin < line.size();)
  {
    std::size_t from = begin;
    if (line[begin] == '"') // quoted text may hold separators
    {
      const std::size_t close = line.find('"', begin + 1);
      from = close == std::string_view::npos ? begin : close;
    }
    const std::size_t found =
      separator == ' ' ? line.find_first_of(blanks, from) : line.find(separator, from);
    const std::size_t end = std::min(found, line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = separator == ' ' ? line.find_first_not_of(blanks, end) : end + 1;
  }
  return cells;
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
