#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// The store is little-endian and its arrays are copied as they lie in memory.
#if !defined(__BYTE_ORDER__) || __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "PointFront's store files need a little-endian machine"
#endif
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);

namespace pointfront
{

/// Appends numbers and texts to a byte array in the store's byte order, without padding.
class ByteWriter
{
public:
  template <typename T>
  void put(T value)
  {
    static_assert(std::is_arithmetic_v<T>);
    putBytes(&value, sizeof(T));
  }
  void putBytes(const void* data, std::size_t size)
  {
    if (size != 0)
    {
      const auto* const begin = static_cast<const std::byte*>(data);
      bytes_.insert(bytes_.end(), begin, begin + size);
    }
  }
  /// 32-bit length, then the bytes.
  void putText(const std::string& text)
  {
    put(static_cast<std::uint32_t>(text.size()));
    putBytes(text.data(), text.size());
  }
  /// Room for so many bytes, which makes it quicker to put them.
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  std::size_t size() const { return bytes_.size(); }
  std::vector<std::byte> take() { return std::move(bytes_); }
  const std::vector<std::byte>& bytes() const { return bytes_; }

private:
  std::vector<std::byte> bytes_;
};

/// Takes numbers and texts from bytes that may be damaged. Missing numbers read as zero and missing
/// texts as empty, and ok() is false from then on, so a parser checks once at its end.
/// Guarantees  never reads outside [data, data + size) and never allocates more than is there.
class ByteReader
{
public:
  ByteReader(const std::byte* data, std::size_t size)
    : data_(data)
    , size_(size)
  {
  }
  template <typename T>
  T get()
  {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    getBytes(&value, sizeof(T));
    return value;
  }
  bool getBytes(void* target, std::size_t size)
  {
    if (size > remaining())
    {
      ok_ = false;
      at_ = size_;
      return false;
    }
    if (size != 0)
    {
      std::memcpy(target, data_ + at_, size);
      at_ += size;
    }
    return true;
  }
  /// So many bytes where they lie; null: they are not there.
  const std::byte* getBytes(std::size_t size)
  {
    if (size > remaining())
    {
      ok_ = false;
      at_ = size_;
      return nullptr;
    }
    at_ += size;
    return data_ + at_ - size;
  }
  std::string getText()
  {
    const std::size_t length = get<std::uint32_t>();
    if (length > remaining())
    {
      ok_ = false;
      at_ = size_;
      return {};
    }
    std::string text(reinterpret_cast<const char*>(data_ + at_), length);
    at_ += length;
    return text;
  }
  std::size_t remaining() const { return size_ - at_; }
  std::size_t position() const { return at_; }
  bool ok() const { return ok_; }

private:
  const std::byte* data_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

} // namespace pointfront
