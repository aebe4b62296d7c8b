#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace pointfront
{

/// LAS is little-endian; so are the machines this library is built for.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "LAS records are read by copying bytes");

/// A run of bytes that someone else owns.
struct ByteSpan
{
  const std::byte* data = nullptr;
  std::size_t size = 0;
};

/// The number whose bytes begin at `from`, which need not be aligned.
template <typename T>
T loadNumber(const std::byte* from)
{
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <typename T>
void storeNumber(std::byte* to, T value)
{
  std::memcpy(to, &value, sizeof(T));
}

/// A fixed-width text field: up to the first NUL, or all of it.
inline std::string loadText(const std::byte* from, std::size_t width)
{
  const char* text = reinterpret_cast<const char*>(from);
  return std::string(text, ::strnlen(text, width));
}

/// Fills a fixed-width text field: cut to `width`, padded with NUL.
inline void storeText(std::byte* to, std::size_t width, std::string_view text)
{
  std::memset(to, 0, width);
  std::memcpy(to, text.data(), text.size() < width ? text.size() : width);
}

} // namespace pointfront
