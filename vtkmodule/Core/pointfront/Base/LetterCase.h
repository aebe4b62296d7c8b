#pragma once

#include <string>
#include <string_view>

namespace pointfront
{

/// Names in which a large letter is as good as a small one: endings of files, attributes, units.
/// Only A to Z have small letters here, whatever the process's locale is: to a Turkish one "I" is
/// not the large letter of "i".
std::string lowered(std::string_view text);
std::string capitals(std::string_view text);

bool sameWithoutCase(std::string_view a, std::string_view b);
bool endsWithoutCase(std::string_view text, std::string_view end);

/// Classes of ASCII, whatever the process's locale is: no byte above 127 belongs to one.
bool isAsciiLetter(char c);
bool isAsciiLetterOrDigit(char c);
bool isAsciiSpace(char c); ///< a blank, a tab, or one of the ends of lines and pages

/// Extension of a file's name in small letters, with its dot: ".laz" of "a/B.LAZ". "": it has none.
std::string loweredExtension(const std::string& path);

} // namespace pointfront
