#include "pointfront/Payload/BufferedOutput.h"

#include <utility>

namespace pointfront
{
namespace
{
/// One write a few nodes: fewer calls, and the disk gets long runs.
constexpr std::size_t writeBufferBytes = std::size_t(3) << 20;
} // namespace

BufferedOutput::BufferedOutput(std::unique_ptr<OutputFile> file)
  : file_(std::move(file))
{
  buffer_.reserve(writeBufferBytes);
}

Result<void> BufferedOutput::put(const std::byte* bytes, std::size_t size)
{
  if (buffer_.size() + size > writeBufferBytes)
  {
    if (Result<void> done = flush(); !done)
    {
      return done;
    }
  }
  end_ += size;
  if (size > writeBufferBytes)
  {
    return file_->append(bytes, size);
  }
  buffer_.insert(buffer_.end(), bytes, bytes + size);
  return {};
}

Result<void> BufferedOutput::flush()
{
  Result<void> done = file_->append(buffer_.data(), buffer_.size());
  buffer_.clear();
  return done;
}

} // namespace pointfront
