#include "PTXTable.h"

#include "TextCells.h"

#include "pointfront/Table/DecimalNumber.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t headerLines = 10;
constexpr double mostOfAGrid = 1e9; // columns, or rows, of one scan

struct ScanHeader
{
  std::array<double, 16> matrix{};
  std::uint64_t rows = 0;
  std::size_t end = 0; ///< first byte behind it
};

/// The numbers of a line if it has exactly `count`.
bool numbersOf(std::string_view line, std::size_t count, double* to)
{
  const std::vector<std::string_view> cells = cellsOf(line, ' ');
  for (std::size_t k = 0; k < count && cells.size() == count; ++k)
  {
    DecimalNumber number;
    const char* const end = cells[k].data() + cells[k].size();
    if (readDecimal(cells[k].data(), end, '.', number) != end)
    {
      return false;
    }
    to[k] = number.value;
  }
  return cells.size() == count;
}

std::optional<ScanHeader> headerAt(std::string_view text, std::size_t begin)
{
  static constexpr std::size_t counts[headerLines] = { 1, 1, 3, 3, 3, 3, 4, 4, 4, 4 };
  ScanHeader header;
  double size[2] = { 0.0, 0.0 };
  double pose[3];
  header.end = begin;
  for (std::size_t i = 0; i < headerLines; ++i)
  {
    std::size_t next = 0;
    const std::string_view line = lineAt(text, header.end, '\n', next);
    double* to = i < 2 ? size + i : i < 6 ? pose : header.matrix.data() + 4 * (i - 6);
    if (header.end >= text.size() || !numbersOf(line, counts[i], to))
    {
      return std::nullopt;
    }
    header.end = next;
  }
  if (!(size[0] >= 0.0 && size[0] <= mostOfAGrid && size[1] >= 0.0 && size[1] <= mostOfAGrid))
  {
    return std::nullopt;
  }
  header.rows = static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]);
  return header;
}

TextLayout layoutOf(std::size_t columns)
{
  TextLayout layout;
  layout.comments = false;
  for (std::size_t c = 0; c < columns; ++c)
  {
    layout.cells.push_back({ c, false });
  }
  layout.fieldCount = columns;
  return layout;
}
} // namespace

bool PTXTable::accepts(std::string_view text)
{
  return headerAt(text, 0).has_value();
}

Result<void> PTXTable::index(const SurveyOptions& survey)
{
  const std::string_view text(reinterpret_cast<const char*>(map_.data()), map_.size());
  TextRegion region;
  std::uint64_t points = 0;
  bool coloured = false;
  while (skipLines(text.data(), region.end, text.size(), 1).found > 0)
  {
    const std::optional<ScanHeader> header = headerAt(text, region.end);
    if (!header)
    {
      return makeError(Error::Kind::BadFormat,
        path_ + ": line " + std::to_string(region.firstLine) + " begins no scan of a PTX file");
    }
    region.begin = header->end;
    const SkippedLines rows = skipLines(text.data(), region.begin, text.size(), header->rows);
    region.firstLine += headerLines;
    region.end = rows.end;
    std::size_t next = 0;
    const std::size_t cells = cellsOf(lineAt(text, region.begin, '\n', next), ' ').size();
    const bool colour = cells >= 7;
    Result<TextRows> read = TextRows::open(map_, region, layoutOf(colour ? 7 : 4), survey);
    if (!read)
    {
      return read.error();
    }
    if (const std::string complaint = read->complaint(); !complaint.empty())
    {
      warnings_.push_back("Scan " + std::to_string(scans_.size() + 1) + ": " + complaint);
    }
    if (rows.found < header->rows)
    {
      warnings_.push_back(std::to_string(header->rows - rows.found) + " of the " +
        std::to_string(header->rows) + " rows that scan " + std::to_string(scans_.size() + 1) +
        " promises are missing.");
    }
    points += read->rows() - read->badRows();
    coloured = coloured || colour;
    for (std::uint64_t chunk = 0; chunk < read->chunkCount(); ++chunk)
    {
      chunks_.push_back({ scans_.size(), chunk });
    }
    scans_.push_back({ header->matrix, header->rows, std::move(*read), colour });
    region.firstLine += rows.lines;
  }
  if (points == 0)
  {
    return makeError(Error::Kind::BadFormat, path_ + ": not one row of its scans is a point");
  }
  fields_ = { { "x", ScalarType::Float64 }, { "y", ScalarType::Float64 },
    { "z", ScalarType::Float64 }, { "intensity", ScalarType::Float32 } };
  for (const char* name : { "red", "green", "blue" })
  {
    if (coloured)
    {
      fields_.push_back({ name, ScalarType::UInt8 });
    }
  }
  return {};
}

Result<std::unique_ptr<PointTable>> PTXTable::open(
  const std::string& path, MemoryMap map, const SurveyOptions& survey)
{
  // The rows keep the map's address: the table must not move once they are there.
  auto table = std::unique_ptr<PTXTable>(new PTXTable(path, std::move(map)));
  if (Result<void> done = table->index(survey); !done)
  {
    return done.error();
  }
  return std::unique_ptr<PointTable>(std::move(table));
}

std::uint64_t PTXTable::chunkRows(std::uint64_t chunk) const
{
  const Chunk& at = chunks_[static_cast<std::size_t>(chunk)];
  return scans_[at.scan].rows.chunkRows(at.chunk);
}

std::vector<ScannerPlace> PTXTable::scanners(const Bounds&) const
{
  std::vector<ScannerPlace> places;
  for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk)
  {
    if (chunk == 0 || chunks_[chunk].scan != chunks_[chunk - 1].scan)
    {
      const std::array<double, 16>& m = scans_[chunks_[chunk].scan].matrix;
      places.push_back({ chunk, { m[12], m[13], m[14] } });
    }
  }
  return places;
}

Result<void> PTXTable::read(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const Chunk& at = chunks_[static_cast<std::size_t>(chunk)];
  const Scan& scan = scans_[at.scan];
  std::vector<bool> own(scan.coloured ? 7 : 4, false);
  for (std::size_t f = 0; f < own.size(); ++f)
  {
    own[f] = f < 3 || (f < wanted.size() && wanted[f]); // all three axes make each
  }
  if (Result<void> done = scan.rows.read(at.chunk, own, block); !done)
  {
    return done;
  }
  std::vector<double>& x = block.columns[0];
  std::vector<double>& y = block.columns[1];
  std::vector<double>& z = block.columns[2];
  const std::array<double, 16>& m = scan.matrix;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const bool nothing = x[i] == 0.0 && y[i] == 0.0 && z[i] == 0.0;
    const double a = nothing ? std::numeric_limits<double>::quiet_NaN() : x[i];
    const double b = y[i];
    const double c = z[i];
    x[i] = a * m[0] + b * m[4] + c * m[8] + m[12];
    y[i] = a * m[1] + b * m[5] + c * m[9] + m[13];
    z[i] = a * m[2] + b * m[6] + c * m[10] + m[14];
  }
  const std::size_t rows = x.size();
  block.columns.resize(fields_.size());
  for (std::size_t f = 0; f < fields_.size(); ++f)
  {
    block.columns[f].resize(wanted[f] ? rows : 0);
  }
  return {};
}

} // namespace pointfront
