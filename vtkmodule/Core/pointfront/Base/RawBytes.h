#pragma once

#include <cstddef>
#include <memory>

namespace pointfront
{

/// Bytes that are written before they are read: not cleared.
struct RawBytes
{
  RawBytes() = default;
  explicit RawBytes(std::size_t bytes)
    : data(new std::byte[bytes])
    , size(bytes)
  {
  }
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;
};

} // namespace pointfront
