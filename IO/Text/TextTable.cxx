#include "TextTable.h"

#include "TextBytes.h"

#include "pointfront/Table/FieldRole.h"

#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t sampleBytes = 1 << 18;

TextLayout layoutOf(const TextColumns& columns, std::vector<TableField>& fields)
{
  TextLayout layout;
  layout.separator = columns.separator;
  layout.decimalPoint = columns.decimalPoint;
  layout.lineEnd = columns.lineEnd;
  layout.countLines = columns.countLines;
  std::size_t used = 0; // cells up to the last that is wanted
  for (const std::string& name : columns.names)
  {
    TextLayout::Cell cell;
    if (roleOf(name).kind != FieldRole::Kind::Padding)
    {
      cell.field = fields.size();
      fields.push_back({ toUtf8(name), std::nullopt });
      used = layout.cells.size() + 1;
    }
    layout.cells.push_back(cell);
  }
  layout.cells.resize(used);
  layout.fieldCount = fields.size();
  return layout;
}
} // namespace

std::string_view beginningOf(const MemoryMap& map)
{
  const std::string_view text(reinterpret_cast<const char*>(map.data()), map.size());
  if (text.size() <= sampleBytes)
  {
    return text;
  }
  const std::string_view start = text.substr(0, sampleBytes);
  const std::size_t lastLine = start.find_last_of("\n\r");
  return lastLine == std::string_view::npos ? start : start.substr(0, lastLine + 1);
}

Result<void> TextTable::index(const TextColumns& columns, const SurveyOptions& survey)
{
  TextLayout layout = layoutOf(columns, fields_);
  if (fields_.empty())
  {
    return makeError(Error::Kind::BadFormat,
      path_ + ": its header leaves every column out; name them with --columns");
  }
  const TextRegion region{ columns.dataBegin, map_.size(), columns.dataLine };
  if (Result<void> opened = openRows(map_, region, std::move(layout), survey); !opened)
  {
    return opened;
  }
  if (rows().badRows() * 2 > rows().rows() || (rows().rows() == 0 && !columns.empty))
  {
    return makeError(Error::Kind::BadFormat,
      path_ +
        ": its lines are no points; say how it is written (--columns, --separator, --decimal, "
        "--skip). " +
        rows().complaint());
  }
  warn(columns);
  return {};
}

void TextTable::warn(const TextColumns& columns)
{
  if (columns.guessed && columns.names.size() > 3)
  {
    std::string names;
    for (const std::string& name : columns.names)
    {
      names += (names.empty() ? "" : ",") + name;
    }
    warnings_.push_back("There is no header: its columns are taken to be " + names +
      "; --columns names them otherwise.");
  }
  complain(warnings_);
  if (columns.countLines && rows().promisedRows() != rows().rows())
  {
    warnings_.push_back("Its count lines promise " + std::to_string(rows().promisedRows()) +
      " points; there are " + std::to_string(rows().rows()) + ".");
  }
}

Result<std::unique_ptr<PointTable>> TextTable::open(
  const std::string& path, MemoryMap map, const TextWishes& wishes, const SurveyOptions& survey)
{
  const Result<TextColumns> columns =
    TextColumns::find(beginningOf(map), wishes.columns, path, wishes.choice);
  if (!columns)
  {
    return columns.error();
  }
  if (columns->empty && beginningOf(map).size() < map.size())
  {
    return makeError(
      Error::Kind::BadFormat, path + ": no line of numbers behind the header at its beginning");
  }
  // The rows keep the map's address: the table must not move once they are there.
  auto table = std::unique_ptr<TextTable>(new TextTable(path, std::move(map)));
  if (Result<void> done = table->index(*columns, survey); !done)
  {
    return done.error();
  }
  return std::unique_ptr<PointTable>(std::move(table));
}

} // namespace pointfront
