#include "TextColumns.h"

#include "TextBytes.h"
#include "TextCells.h"
#include "TextGuess.h"

#include "pointfront/Table/DecimalNumber.h"
#include "pointfront/Table/FieldRole.h"
#include "pointfront/Table/TextLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
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

/// The share of the cells that are numbers; 0 for a line that is no row.
double numericShare(std::string_view line, const Dialect& dialect)
{
  if (!isRow(line, dialect))
  {
    return 0.0;
  }
  const std::vector<std::string_view> cells = cellsOf(line, dialect.separator);
  double numbers = 0.0;
  for (const std::string_view cell : cells)
  {
    numbers += isNumber(cell, dialect.decimalPoint) ? 1.0 : 0.0;
  }
  return numbers / static_cast<double>(cells.size());
}

/// The dialect with which most cells of the first lines are numbers; of equals the first here.
std::optional<Dialect> dialectOf(
  std::string_view text, const TextColumns& columns, const TextChoice& choice)
{
  static constexpr Dialect dialects[] = { { ';', '.' }, { ';', ',' }, { ',', '.' }, { '\t', '.' },
    { '\t', ',' }, { ' ', '.' }, { ' ', ',' }, { ',', ',' } };
  constexpr std::size_t lines = 200;
  std::array<double, std::size(dialects)> shares{};
  std::size_t next = 0;
  std::size_t seen = 0;
  for (std::size_t begin = columns.dataBegin; begin < text.size() && seen < lines; begin = next)
  {
    const std::string_view line = lineAt(text, begin, columns.lineEnd, next);
    if (isBlankText(line) || isCommentText(line) || isCountText(line))
    {
      continue;
    }
    ++seen;
    for (std::size_t d = 0; d < shares.size(); ++d)
    {
      const Dialect& dialect = dialects[d];
      const bool separated =
        dialect.separator == ' ' || line.find(dialect.separator) != std::string_view::npos;
      shares[d] += separated ? numericShare(line, dialect) : 0.0;
    }
  }
  std::optional<std::size_t> best;
  for (std::size_t d = 0; d < shares.size(); ++d)
  {
    const bool may = (choice.separator == '\0' || choice.separator == dialects[d].separator) &&
      (choice.decimalPoint == '\0' || choice.decimalPoint == dialects[d].decimalPoint);
    best = may && shares[d] > (best ? shares[*best] : 0.0) ? d : best;
  }
  return best ? std::make_optional(dialects[*best]) : std::nullopt;
}

std::vector<std::string> namesIn(std::string_view line, char separator)
{
  while (!line.empty() && (line.front() == '#' || line.front() == '/' || line.front() == '%'))
  {
    line.remove_prefix(1);
  }
  const bool apart = line.find(separator) != std::string_view::npos;
  return textsOf(line, apart ? separator : separatorOf(line));
}

/// Bits of the coordinates that are named.
unsigned namedAxes(const std::vector<std::string>& names)
{
  unsigned found = 0;
  for (const FieldRole& role : rolesOf(names))
  {
    found |= role.kind == FieldRole::Kind::Position ? 1u << role.component : 0u;
  }
  return found;
}

bool nameXAndY(const std::vector<std::string>& names)
{
  return (namedAxes(names) & 3u) == 3u;
}

/// A header that names x and y, and no z, although a column whose name says nothing may be it.
Result<void> checkHeight(const std::vector<std::string>& names, const std::string& path)
{
  if (namedAxes(names) != 3u)
  {
    return {};
  }
  for (const std::string& name : names)
  {
    const FieldRole role = roleOf(name);
    if (role.kind == FieldRole::Kind::Attribute && !role.type)
    {
      return makeError(Error::Kind::BadFormat,
        path + ": its header names no z, unless it is '" + toUtf8(name) +
          "'; name the columns with --columns (x,y,z or, if it is flat, x,y,-)");
    }
  }
  return {};
}

/// The lines in front of the first row.
struct Beginning
{
  std::optional<Dialect> dialect;
  std::string_view comment; ///< the last before it
  std::string_view header; ///< the last line of words before it
  std::size_t lines = 0; ///< lines of words before it
  bool counts = false; ///< a lone integer is among them
};

/// Whether text of one header and no row names x and y, or a comment all three, as exports of no
/// points are written.
bool namesNothing(std::string_view text, const Beginning& beginning, TextColumns& columns)
{
  constexpr unsigned allAxes = 7;
  const std::string_view line = beginning.lines > 0 ? beginning.header : beginning.comment;
  if (beginning.lines > 1 || beginning.counts)
  {
    return false;
  }
  columns.separator = separatorOf(line);
  columns.names = namesIn(line, columns.separator);
  columns.empty =
    beginning.lines > 0 ? nameXAndY(columns.names) : namedAxes(columns.names) == allAxes;
  columns.dataBegin = text.size();
  return columns.empty;
}

/// Passes the mark of UTF-8 and the lines to skip.
void begin(std::string_view text, std::uint64_t skip, TextColumns& columns)
{
  columns.dataBegin = markBytes(text);
  for (; skip > 0 && columns.dataBegin < text.size(); --skip, ++columns.dataLine)
  {
    std::size_t next = 0;
    lineAt(text, columns.dataBegin, columns.lineEnd, next);
    columns.dataBegin = next;
  }
}

/// Looks for the first row from dataBegin on; places dataBegin, dataLine and countLines.
Beginning findRow(std::string_view text, const TextChoice& choice, TextColumns& columns)
{
  Beginning beginning;
  const std::optional<Dialect> dialect = dialectOf(text, columns, choice);
  bool counted = false;
  std::size_t next = 0;
  std::uint64_t number = columns.dataLine;
  for (std::size_t begin = columns.dataBegin; begin < text.size(); begin = next, ++number)
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
    beginning.dialect = !count && dialect && isRow(line, *dialect) ? dialect : std::nullopt;
    if (!counted)
    {
      columns.dataBegin = begin;
      columns.dataLine = number;
    }
    if (beginning.dialect)
    {
      break;
    }
    counted = count;
    beginning.header = count ? beginning.header : line;
    beginning.lines += count ? 0 : 1;
    beginning.counts = beginning.counts || count;
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
      const double value = std::isfinite(number.value) ? number.value : 0.0; // "nan" is a number
      row.push_back(is ? value : std::numeric_limits<double>::quiet_NaN());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// How many cells most rows have.
std::size_t usualCells(const std::vector<std::vector<double>>& rows)
{
  std::map<std::size_t, std::size_t> counts;
  for (const std::vector<double>& row : rows)
  {
    ++counts[row.size()];
  }
  std::size_t usual = 0;
  for (const auto& [cells, count] : counts)
  {
    usual = usual == 0 || count > counts[usual] ? cells : usual;
  }
  return usual;
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
      path + ": " + std::to_string(wanted.size()) + " columns were given, its rows have " +
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

/// Text without a row: an empty cloud if a header says so.
Result<TextColumns> withoutRows(std::string_view text, const Beginning& beginning,
  const std::vector<std::string>& wanted, const std::string& path, TextColumns columns)
{
  if (!namesNothing(text, beginning, columns))
  {
    return makeError(Error::Kind::BadFormat,
      path + ": no line of numbers in the first " + std::to_string(text.size()) + " bytes");
  }
  columns.names = wanted.empty() ? columns.names : wanted;
  if (Result<void> checked = checkTwice(columns.names, path); !checked)
  {
    return checked.error();
  }
  return columns;
}
} // namespace

Result<TextColumns> TextColumns::find(std::string_view text, const std::vector<std::string>& wanted,
  const std::string& path, const TextChoice& choice)
{
  TextColumns columns;
  const bool unixLines = text.find('\n') != std::string_view::npos;
  columns.lineEnd = unixLines || text.find('\r') == std::string_view::npos ? '\n' : '\r';
  begin(text, choice.skip, columns);
  const Beginning beginning = findRow(text, choice, columns);
  if (!beginning.dialect)
  {
    return withoutRows(text, beginning, wanted, path, std::move(columns));
  }
  columns.separator = beginning.dialect->separator;
  columns.decimalPoint = beginning.dialect->decimalPoint;
  const std::vector<std::vector<double>> rows = firstRows(text, columns);
  const std::size_t there = usualCells(rows);
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
    columns.names = guessColumns(rows, there);
    columns.guessed = true;
  }
  if (wanted.empty() && !columns.guessed)
  {
    if (Result<void> checked = checkHeight(columns.names, path); !checked)
    {
      return checked.error();
    }
  }
  if (Result<void> checked = checkTwice(columns.names, path); !checked)
  {
    return checked.error();
  }
  return columns;
}

} // namespace pointfront
