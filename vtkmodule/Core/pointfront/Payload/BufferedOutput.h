#pragma once

#include "pointfront/Disk/OutputFile.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Appends to a file with few, long writes.
/// Threads  one.
/// Errors   those of OutputFile.
class BufferedOutput
{
public:
  explicit BufferedOutput(std::unique_ptr<OutputFile> file);

  Result<void> put(const std::byte* bytes, std::size_t size);
  Result<void> put(const std::vector<std::byte>& bytes) { return put(bytes.data(), bytes.size()); }
  /// Hands what was put to the file.
  Result<void> flush();

  /// Where the next byte goes.
  std::uint64_t end() const { return end_; }
  OutputFile& file() { return *file_; }
  const OutputFile& file() const { return *file_; }

private:
  std::unique_ptr<OutputFile> file_;
  std::vector<std::byte> buffer_;
  std::uint64_t end_ = 0;
};

} // namespace pointfront
