#pragma once

#include <string>
#include <string_view>

namespace pointfront
{

/// The hash of a text in 64 hexadecimal digits, from which the text cannot be told.
/// Source  FIPS 180-4, sections 5 and 6.2.
std::string sha256(std::string_view text);

} // namespace pointfront
