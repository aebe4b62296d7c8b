#pragma once

#include "pointfront/Table/DecimalNumber.h"
#include "pointfront/Table/TextRows.h"

#include <vector>

namespace pointfront
{

/// The kind of a line of a table.
enum class TextLine
{
  Nothing, ///< blank, or a comment
  Row,
  Count, ///< a lone integer where the layout has such lines: number[0]
  Bad ///< neither
};

/// Takes the line [text, end), without its line end, apart. `numbers` has fieldCount elements, at
/// least one; all that have a cell are filled when it is a Row.
TextLine readLine(
  const char* text, const char* end, const TextLayout& layout, std::vector<DecimalNumber>& numbers);

/// True for a line with nothing but blanks.
bool isBlankLine(const char* text, const char* end);
/// True if it begins like a comment: #, // or %.
bool isCommentLine(const char* text, const char* end);

} // namespace pointfront
