#include "pointfront/Table/TextRows.h"

#include "pointfront/Table/TextLine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t chunkBytes = 1 << 20;
constexpr std::size_t shownText = 40;

/// Where the line that begins at `p` ends; `next` is where the following one begins.
const char* endOfLine(const char* p, const char* end, char lineEnd, const char*& next)
{
  const auto* found =
    static_cast<const char*>(std::memchr(p, lineEnd, static_cast<std::size_t>(end - p)));
  next = found != nullptr ? found + 1 : end;
  return found != nullptr ? found : end;
}

constexpr std::uint64_t beyondSigned = std::uint64_t(1) << 63;
constexpr int exactDigits = 15; ///< a double holds every number of so many

bool isRounded(const DecimalNumber& number)
{
  // 2^64 as a double is one too many for the way back.
  constexpr double end = 18446744073709551616.0;
  const double rounded = static_cast<double>(number.magnitude);
  return number.integer
    ? rounded >= end || static_cast<std::uint64_t>(rounded) != number.magnitude
    : !number.pointSeen && std::isfinite(number.value) && number.digits > exactDigits;
}

void addNumber(FieldStatistics& statistics, const DecimalNumber& number)
{
  const bool beyond = number.integer && number.magnitude >= beyondSigned;
  const bool negative = std::signbit(number.value);
  statistics.integers =
    statistics.integers && number.integer && !(negative && number.magnitude > beyondSigned);
  statistics.beyondInt64 = statistics.beyondInt64 || (beyond && !negative);
  statistics.rounded = statistics.rounded || isRounded(number);
  statistics.add(number.value);
  statistics.decimals = std::max(statistics.decimals, number.decimals);
  statistics.digits = std::max(statistics.digits, number.digits);
  statistics.pointSeen = statistics.pointSeen || number.pointSeen;
}

std::string printable(const char* text, const char* end)
{
  std::string shown;
  for (; text != end && shown.size() < shownText; ++text)
  {
    shown += *text >= ' ' && *text <= '~' ? *text : ' ';
  }
  return text == end ? shown : shown + "...";
}
} // namespace

struct TextRows::Findings
{
  std::uint64_t rows = 0;
  std::uint64_t lines = 0;
  std::uint64_t badRows = 0;
  std::uint64_t promisedRows = 0;
  std::uint64_t firstBadLine = 0; ///< within the chunk, from 0
  std::string firstBad;
  std::vector<FieldStatistics> statistics;
};

void TextRows::cut(const TextRegion& region)
{
  std::size_t begin = region.begin;
  while (begin < region.end)
  {
    std::size_t end = region.end;
    if (region.end - begin > chunkBytes)
    {
      const char* next = nullptr;
      endOfLine(text(begin + chunkBytes - 1), text(region.end), layout_.lineEnd, next);
      end = static_cast<std::size_t>(next - text(0));
    }
    chunks_.push_back({ begin, end, 0 });
    begin = end;
  }
}

TextRows::Findings TextRows::look(const Chunk& chunk) const
{
  Findings found;
  found.statistics.resize(layout_.fieldCount);
  std::vector<DecimalNumber> numbers(layout_.fieldCount);
  const char* const end = text(chunk.end);
  const char* next = nullptr;
  for (const char* line = text(chunk.begin); line != end; line = next, ++found.lines)
  {
    const char* const lineEnd = endOfLine(line, end, layout_.lineEnd, next);
    switch (readLine(line, lineEnd, layout_, numbers))
    {
      case TextLine::Nothing:
        break;
      case TextLine::Count:
        found.promisedRows += static_cast<std::uint64_t>(numbers[0].value);
        break;
      case TextLine::Bad:
        if (found.badRows++ == 0)
        {
          found.firstBadLine = found.lines;
          found.firstBad = printable(line, lineEnd);
        }
        ++found.rows;
        break;
      case TextLine::Row:
        ++found.rows;
        for (std::size_t f = 0; f < numbers.size(); ++f)
        {
          addNumber(found.statistics[f], numbers[f]);
        }
        break;
    }
  }
  map_->release(chunk.begin, chunk.end - chunk.begin);
  return found;
}

Result<TextRows> TextRows::open(
  const MemoryMap& map, const TextRegion& region, TextLayout layout, const SurveyOptions& options)
{
  assert(layout.fieldCount > 0 && region.end <= map.size());
  TextRows rows(map, std::move(layout));
  rows.cut(region);
  std::vector<Findings> findings(rows.chunks_.size());
  const Result<void> done = forEachChunk(rows.chunks_.size(), options,
    [&](std::uint64_t chunk) -> Result<void>
    {
      const auto c = static_cast<std::size_t>(chunk);
      findings[c] = rows.look(rows.chunks_[c]);
      return map.checkWhole();
    });
  if (!done)
  {
    return done.error();
  }
  rows.statistics_.resize(rows.layout_.fieldCount);
  std::uint64_t line = region.firstLine;
  for (std::size_t c = 0; c < findings.size(); ++c)
  {
    const Findings& found = findings[c];
    rows.chunks_[c].rows = found.rows;
    rows.rows_ += found.rows;
    rows.promisedRows_ += found.promisedRows;
    if (rows.badRows_ == 0 && found.badRows > 0)
    {
      rows.firstBadLine_ = line + found.firstBadLine;
      rows.firstBad_ = found.firstBad;
    }
    rows.badRows_ += found.badRows;
    for (std::size_t f = 0; f < rows.statistics_.size(); ++f)
    {
      rows.statistics_[f].add(found.statistics[f]);
    }
    line += found.lines;
  }
  const auto empty = [](const Chunk& chunk) { return chunk.rows == 0; };
  rows.chunks_.erase(
    std::remove_if(rows.chunks_.begin(), rows.chunks_.end(), empty), rows.chunks_.end());
  return rows;
}

Result<void> TextRows::read(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const Chunk& piece = chunks_[static_cast<std::size_t>(chunk)];
  block.resize(static_cast<std::size_t>(piece.rows), wanted);
  std::vector<DecimalNumber> numbers(layout_.fieldCount);
  std::vector<std::pair<std::size_t, std::uint64_t*>> exact; // fields, and where they go
  for (std::size_t f = 0; f < numbers.size(); ++f)
  {
    if (wanted[f] && statistics_[f].wideIntegers())
    {
      exact.emplace_back(f, block.wholesOf(f).data());
    }
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const char* const end = text(piece.end);
  const char* next = nullptr;
  std::size_t row = 0;
  // The file may have been changed since it was opened: never more rows than were counted.
  for (const char* line = text(piece.begin); line != end && row < piece.rows; line = next)
  {
    const char* const lineEnd = endOfLine(line, end, layout_.lineEnd, next);
    const TextLine kind = readLine(line, lineEnd, layout_, numbers);
    if (kind == TextLine::Nothing || kind == TextLine::Count)
    {
      continue;
    }
    for (std::size_t f = 0; f < numbers.size(); ++f)
    {
      if (wanted[f])
      {
        block.columns[f][row] = kind == TextLine::Row ? numbers[f].value : nothing;
      }
    }
    for (const auto& [f, to] : exact)
    {
      const std::uint64_t magnitude = kind == TextLine::Row ? numbers[f].magnitude : 0;
      to[row] = numbers[f].value < 0.0 ? 0 - magnitude : magnitude;
    }
    ++row;
  }
  map_->release(piece.begin, piece.end - piece.begin);
  return map_->checkWhole();
}

std::string TextRows::complaint() const
{
  if (badRows_ == 0)
  {
    return {};
  }
  return std::to_string(badRows_) + " of " + std::to_string(rows_) +
    " lines are no points and are rejected; the first is line " + std::to_string(firstBadLine_) +
    ": '" + firstBad_ + "'.";
}

SkippedLines skipLines(
  const char* text, std::size_t begin, std::size_t end, std::uint64_t count, char lineEnd)
{
  SkippedLines skipped;
  const char* next = text + begin;
  while (next != text + end && skipped.found < count)
  {
    const char* const line = next;
    const char* const stop = endOfLine(line, text + end, lineEnd, next);
    skipped.found += isBlankLine(line, stop) ? 0 : 1;
    ++skipped.lines;
  }
  skipped.end = static_cast<std::size_t>(next - text);
  return skipped;
}

} // namespace pointfront
