#pragma once

#include <string>

namespace pointfront
{

/// The same text, safe to print on a terminal and to put into JSON: tabs and line ends become
/// blanks, other control characters '_', and so do all bytes above 127 unless the whole is valid
/// UTF-8.
std::string printableText(std::string text);

} // namespace pointfront
