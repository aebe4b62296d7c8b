#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/HeldBytes.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// A far source as if it lay in memory: each byte has its address, but only the parts that were
/// wanted are there, the others read as 0. So code that walks a mapped file by its offsets walks a
/// far one, if who calls it wants first what it walks over.
/// Memory   address space for the whole source, real memory for what was wanted: at most
///          `mostBytes` in total.
/// Threads  want() by one at a time, not while others read; data() from any.
class SparseBytes
{
public:
  static constexpr std::uint64_t mostBytes = std::uint64_t(256) << 20;

  /// Errors  NoMemory: no addresses for so large a source.
  static Result<std::shared_ptr<SparseBytes>> over(std::shared_ptr<const ByteSource> source);
  ~SparseBytes();
  SparseBytes(const SparseBytes&) = delete;
  SparseBytes& operator=(const SparseBytes&) = delete;

  /// Reads the parts together, as far as they lie in the source.
  /// Errors  those of the source; NoMemory: more than `mostBytes` in total.
  Result<void> want(const std::vector<HeldBytes::Part>& parts);

  const std::shared_ptr<const ByteSource>& source() const { return source_; }
  const std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

private:
  SparseBytes() = default;

  std::shared_ptr<const ByteSource> source_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::uint64_t wanted_ = 0;
};

} // namespace pointfront
