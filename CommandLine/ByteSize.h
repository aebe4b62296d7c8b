#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace pointfront
{

/// Bytes of "1048576", "512M", "4G", "1.5GiB": K, M, G, T are powers of 1024, with or without an
/// "iB" or "B" behind, upper or lower case. Nothing if the text is not a size, is not positive or
/// does not fit into 63 bits.
std::optional<std::uint64_t> parseByteSize(const std::string& text);
/// True for a size that is written well, but is nothing or more than that.
bool isByteSizeOutOfRange(const std::string& text);

/// "12.3 MiB", for people.
std::string byteSizeText(std::uint64_t bytes);

} // namespace pointfront
