#pragma once

#include "TextFormat.h"

#include "pointfront/Base/Result.h"

#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// How the lines of a point file are to be read: found by looking at its beginning.
struct TextColumns
{
  std::vector<std::string> names; ///< name of each column; "-": left out
  char separator = ' '; ///< as in TextLayout
  char decimalPoint = '.';
  char lineEnd = '\n';
  std::size_t dataBegin = 0; ///< first byte behind comments and header
  std::uint64_t dataLine = 1; ///< number of the line that begins there
  bool countLines = false; ///< PTS: a lone integer says how many points follow
  bool guessed = false; ///< neither a header nor the user named the columns
  bool empty = false; ///< a header and no row: a cloud of no points, if `text` is the whole file

  /// `text` is the file, or its beginning; `wanted` the names that the user gave, or empty.
  /// Header   the first line with a word that is no number, or the comment before the first row if
  ///          it names as many columns as that has. Names as roleOf() knows them.
  /// Guess    without a header: x, y, z; then by what the first rows hold: colours are three
  ///          columns of integers, or of fractions, from 0 on; normals are three of length 1; one
  ///          more beside them (or alone) is the intensity; what is left is "column_7".
  /// Dialect  separator and decimal point with which most cells of the first lines are numbers.
  /// Errors   BadFormat: no row of numbers in `text`, columns of one name, a header that names x
  ///          and y, no z, and something unknown that may be it; BadArgument: `wanted` names no x
  ///          and y, or more columns than there are.
  static Result<TextColumns> find(std::string_view text, const std::vector<std::string>& wanted,
    const std::string& path, const TextChoice& choice = {});
};

} // namespace pointfront
