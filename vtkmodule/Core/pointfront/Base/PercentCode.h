#pragma once

#include <string>
#include <string_view>

namespace pointfront
{

/// "%20" for a blank: how a URI writes bytes that would mean something else in it, or may not stand
/// there. Letters and digits of ASCII and the `kept` characters stay; all other bytes are written
/// as "%XX". Source  RFC 3986, section 2.1.
std::string percentEncoded(std::string_view text, std::string_view kept);
/// A '%' without two hexadecimal digits behind it stays.
std::string percentDecoded(std::string_view text);
/// Whether "%XX" stands at that place.
bool isPercentCode(std::string_view text, std::size_t at);

} // namespace pointfront
