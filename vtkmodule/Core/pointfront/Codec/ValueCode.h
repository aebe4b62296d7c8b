#pragma once

#include <cassert>
#include <cstdint>
#include <type_traits>

namespace pointfront
{

/// Folds a difference (modulo 2^bits): 0, -1, 1, -2, 2 ... become 0, 1, 2, 3, 4 ...
template <typename T>
constexpr T zigzag(T difference)
{
  using Signed = std::make_signed_t<T>;
  const T sign = static_cast<Signed>(difference) < 0 ? static_cast<T>(~T(0)) : T(0);
  return static_cast<T>(static_cast<T>(difference << 1) ^ sign);
}

template <typename T>
constexpr T unzigzag(T code)
{
  return static_cast<T>((code >> 1) ^ static_cast<T>(T(0) - static_cast<T>(code & 1)));
}

/// Calls f with a zero of the unsigned type that has that many bytes (1, 2, 4 or 8).
template <typename F>
decltype(auto) withUnsigned(unsigned scalarBytes, const F& f)
{
  switch (scalarBytes)
  {
    case 1:
      return f(std::uint8_t{});
    case 2:
      return f(std::uint16_t{});
    case 4:
      return f(std::uint32_t{});
    default:
      assert(scalarBytes == 8);
      return f(std::uint64_t{});
  }
}

} // namespace pointfront
