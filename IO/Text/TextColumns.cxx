#include "TextColumns.h"

#include "TextCells.h"
#include "TextGuess.h"

#include "pointfront/Table/DecimalNumber.h"
#include "pointfront/Table/FieldRole.h"
#include "pointfront/Table/TextLine.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace pointfront
{
namespace
{
constexpr std::size_t guessedRows = 1000;
constexpr std::size_t mostColumns = 1000;

/// How the numbers of a line stand.
struct Dialect
{
  char separator;
  char decimalPoint;
};

bool isRow(std::string_view line, const Dialect& dialect)
{
  std::size_t numbers = 0;
  const std::vector<std::string_view> cells = cellsOf(line, dialect.separator);
  for (const std::string_view cell : cells)
  {
    numbers += isNumber(cell, dialect.decimalPoint) ? 1 : 0;
  }
  // An identifier in front of a point is a row; a sentence with a date in it is none.
  return numbers >= 2 && numbers * 2 >= cells.size();
}

std::optional<Dialect> dialectOf(std::string_view line)
{
  static constexpr Dialect dialects[] = { { ';', '.' }, { ';', ',' }, { ',', '.' }, { '\t', '.' },
    { '\t', ',' }, { ' ', '.' }, { ' ', ',' } };
  for (const Dialect& dialect : dialects)
  {
    const bool separated =
      dialect.separator == ' ' || line.find(dialect.separator) != std::string_view::npos;
    if (separated && isRow(line, dialect))
    {
      return dialect;
    }
  }
  return std::nullopt;
}

bool isCommentText(std::string_view line)
{
  return isCommentLine(line.data(), line.data() + line.size());
}

bool isBlankText(std::string_view line)
{
  return isBlankLine(line.data(), line.data() + line.size());
}

bool isCountText(std::string_view line)
{
  const std::vector<std::string_view> cells = cellsOf(line, ' ');
  return cells.size() == 1 && cells[0].find_first_not_of("0123456789") == std::string_view::npos;
}

std::vector<std::string> namesIn(std::string_view line, char separator)
{
  while (!line.empty() && (line.front() == '#' || line.front() == '/' || line.front() == '%'))
  {
    line.remove_prefix(1);
  }
  const bool apart = line.find(separator) != std::string_view::npos;
  const std::vector<std::string_view> cells =
    cellsOf(line, apart ? separator : separatorOf(line));
  return { cells.begin(), cells.end() };
}

bool nameXAndY(const std::vector<std::string>& names)
{
  unsigned found = 0;
  for (const std::string& name : names)
  {
    const FieldRole role = roleOf(name);
    found |= role.kind == FieldRole::Kind::Position ? 1u << role.component : 0u;
  }
  return (found & 3u) == 3u;
}

/// What stands in front of the first row.
struct Beginning
{
  std::optional<Dialect> dialect;
  std::string_view row;     ///< the first
  std::string_view comment; ///< the last before it
  std::string_view header;  ///< the last line of words before it
};

/// Looks for the first row; places dataBegin, dataLine and countLines.
Beginning findRow(std::string_view text, TextColumns& columns)
{
  Beginning beginning;
  bool counted = false;
  std::size_t next = 0;
  std::uint64_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); begin = next, ++number)
  {
    const std::string_view line = lineAt(text, begin, columns.lineEnd, next);
    if (isBlankText(line))
    {
      continue;
    }
    if (isCommentText(line))
    {
      beginning.comment = line;
      continue;
    }
    const bool count = isCountText(line);
    beginning.dialect = count ? std::nullopt : dialectOf(line);
    if (!counted)
    {
      columns.dataBegin = begin;
      columns.dataLine = number;
    }
    if (beginning.dialect)
    {
      beginning.row = line;
      break;
    }
    counted = count;
    beginning.header = count ? beginning.header : line;
  }
  columns.countLines = counted;
  return beginning;
}

std::vector<std::vector<double>> firstRows(std::string_view text, const TextColumns& columns)
{
  std::vector<std::vector<double>> rows;
  std::size_t next = 0;
  for (std::size_t begin = columns.dataBegin; begin < text.size() && rows.size() < guessedRows;
       begin = next)
  {
    const std::string_view line = lineAt(text, begin, columns.lineEnd, next);
    if (isCommentText(line) || !isRow(line, { columns.separator, columns.decimalPoint }))
    {
      continue;
    }
    std::vector<double> row;
    for (const std::string_view cell : cellsOf(line, columns.separator))
    {
      DecimalNumber number;
      const bool is = isNumber(cell, columns.decimalPoint);
      if (is)
      {
        readDecimal(cell.data(), cell.data() + cell.size(), columns.decimalPoint, number);
      }
      row.push_back(is ? number.value : std::numeric_limits<double>::quiet_NaN());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Result<void> checkWanted(
  const std::vector<std::string>& wanted, std::size_t there, const std::string& path)
{
  if (!nameXAndY(wanted))
  {
    return makeError(Error::Kind::BadArgument, "the columns that were given name no x and y");
  }
  if (wanted.size() > there)
  {
    return makeError(Error::Kind::BadArgument,
      path + ": " + std::to_string(wanted.size()) + " columns were given, its first row has " +
        std::to_string(there));
  }
  return {};
}

Result<void> checkTwice(const std::vector<std::string>& names, const std::string& path)
{
  std::vector<std::string> sorted;
  for (const std::string& name : names)
  {
    if (roleOf(name).kind != FieldRole::Kind::Padding)
    {
      sorted.push_back(name);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
  {
    return makeError(Error::Kind::BadFormat,
      path + ": the column '" + *twice + "' is named twice; name the columns with --columns");
  }
  return {};
}
} // namespace

Result<TextColumns> TextColumns::find(
  std::string_view text, const std::vector<std::string>& wanted, const std::string& path)
{
  TextColumns columns;
  const bool unixLines = text.find('\n') != std::string_view::npos;
  columns.lineEnd = unixLines || text.find('\r') == std::string_view::npos ? '\n' : '\r';
  const Beginning beginning = findRow(text, columns);
  if (!beginning.dialect)
  {
    return makeError(Error::Kind::BadFormat,
      path + ": no line of numbers in the first " + std::to_string(text.size()) + " bytes");
  }
  columns.separator = beginning.dialect->separator;
  columns.decimalPoint = beginning.dialect->decimalPoint;
  const std::size_t there = cellsOf(beginning.row, columns.separator).size();
  if (there > mostColumns)
  {
    return makeError(Error::Kind::Unsupported,
      path + ": rows of more than " + std::to_string(mostColumns) + " columns");
  }
  const std::vector<std::string> header = namesIn(beginning.header, columns.separator);
  const std::vector<std::string> comment = namesIn(beginning.comment, columns.separator);
  if (!wanted.empty())
  {
    if (Result<void> checked = checkWanted(wanted, there, path); !checked)
    {
      return checked.error();
    }
    columns.names = wanted;
  }
  else if (nameXAndY(header) || (header.size() == there && there > 2))
  {
    columns.names = header;
  }
  else if (nameXAndY(comment) && comment.size() == there)
  {
    columns.names = comment;
  }
  else
  {
    columns.names = guessColumns(firstRows(text, columns));
    columns.guessed = true;
  }
  if (Result<void> checked = checkTwice(columns.names, path); !checked)
  {
    return checked.error();
  }
  return columns;
}

} // namespace pointfront
