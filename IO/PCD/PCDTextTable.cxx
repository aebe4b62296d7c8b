#include "PCDTextTable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pointfront
{
namespace
{
/// One of the four bytes of a number that packs a colour; 0 if it is none.
double unpacked(double number, ScalarType type, std::size_t byte)
{
  std::uint32_t bits = 0;
  if (!std::isfinite(number))
  {
    return 0.0;
  }
  if (type == ScalarType::Float32)
  {
    const auto value = static_cast<float>(number);
    std::memcpy(&bits, &value, sizeof bits);
  }
  else if (number >= -2147483648.0 && number <= 4294967295.0)
  {
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
  }
  return static_cast<double>(bits >> (8 * byte) & 255u);
}
} // namespace

TextLayout PCDTextTable::layOut()
{
  TextLayout layout;
  std::size_t next = 0; // number of the next of file_.fields
  for (std::size_t f = 0; f < file_.header.fields.size(); ++f)
  {
    const PCDField& field = file_.header.fields[f];
    for (std::size_t k = 0; k < field.count; ++k)
    {
      TextLayout::Cell cell;
      if (next < file_.fields.size() && file_.elements[next].field == f)
      {
        cell.field = layout.fieldCount++;
        const std::size_t uses = field.isPackedColour() ? 3 : 1;
        columns_.insert(columns_.end(), uses, *cell.field);
        next += uses;
      }
      layout.cells.push_back(cell);
    }
  }
  layout.comments = false;
  return layout;
}

Result<void> PCDTextTable::index(const SurveyOptions& survey)
{
  const char* text = reinterpret_cast<const char*>(file_.map.data());
  const std::size_t begin = file_.header.dataOffset;
  const SkippedLines points = skipLines(text, begin, file_.map.size(), file_.header.points);
  if (Result<std::uint64_t> present = file_.countPresent(points.found); !present)
  {
    return present.error();
  }
  TextLayout layout = layOut();
  const SkippedLines first = skipLines(text, begin, points.end, 1);
  const std::string_view line(text + begin, first.end - begin);
  layout.separator = line.find(',') != std::string_view::npos ? ',' : ' ';
  const TextRegion region{ begin, points.end, file_.header.lines + 1 };
  if (Result<void> opened = openRows(file_.map, region, std::move(layout), survey); !opened)
  {
    return opened;
  }
  complain(file_.warnings);
  std::vector<FieldStatistics> values = statistics();
  for (std::size_t f = 0; f < values.size(); ++f)
  {
    // Red, green and blue are bytes of the number that stands there.
    const bool packed = std::count(columns_.begin(), columns_.end(), columns_[f]) > 1;
    values[f] = packed ? FieldStatistics() : values[f];
  }
  widenTypes(values, file_.fields, file_.warnings);
  return {};
}

Result<std::unique_ptr<PointTable>> PCDTextTable::open(PCDFile file, const SurveyOptions& survey)
{
  // The rows keep the map's address: the table must not move once they are there.
  auto table = std::unique_ptr<PCDTextTable>(new PCDTextTable(std::move(file)));
  if (Result<void> done = table->index(survey); !done)
  {
    return done.error();
  }
  return std::unique_ptr<PointTable>(std::move(table));
}

std::vector<FieldStatistics> PCDTextTable::statistics() const
{
  std::vector<FieldStatistics> statistics;
  for (const std::size_t column : columns_)
  {
    statistics.push_back(rows().statistics()[column]);
  }
  return statistics;
}

Result<void> PCDTextTable::read(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  std::vector<bool> wantedNumbers(rows().statistics().size(), false);
  for (std::size_t f = 0; f < wanted.size(); ++f)
  {
    wantedNumbers[columns_[f]] = wantedNumbers[columns_[f]] || wanted[f];
  }
  TableBlock numbers;
  if (Result<void> done = rows().read(chunk, wantedNumbers, numbers); !done)
  {
    return done;
  }
  block.resize(0, wanted);
  for (std::size_t f = 0; f < wanted.size(); ++f)
  {
    block.columns[f].clear();
    if (!wanted[f])
    {
      continue;
    }
    block.columns[f] = numbers.columns[columns_[f]];
    if (columns_[f] < numbers.wholes.size() && !numbers.wholes[columns_[f]].empty())
    {
      block.wholesOf(f) = numbers.wholes[columns_[f]];
    }
    const PCDFile::Element& element = file_.elements[f];
    const PCDField& field = file_.header.fields[element.field];
    if (field.isPackedColour())
    {
      for (double& value : block.columns[f])
      {
        value = unpacked(value, field.type, element.byte);
      }
    }
  }
  return {};
}

} // namespace pointfront
