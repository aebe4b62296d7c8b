#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// The lines at the beginning of a text file, taken apart without knowing what they mean.

/// The cells of a line; separator as in TextLayout. Blanks and quotes around a cell are dropped.
std::vector<std::string_view> cellsOf(std::string_view line, char separator);
/// The same, with two quotes in a row inside quoted text as the one that they stand for.
std::vector<std::string> textsOf(std::string_view line, char separator);
/// True if the whole cell is a number.
bool isNumber(std::string_view cell, char decimalPoint);
/// ';', ',', a tab, or blanks: the strongest that the line holds.
char separatorOf(std::string_view line);
/// The line that begins at `begin`; `next` is where the following one begins.
std::string_view lineAt(std::string_view text, std::size_t begin, char lineEnd, std::size_t& next);

} // namespace pointfront
