#include "pointfront/Disk/SparseBytes.h"

#include <sys/mman.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pointfront
{

Result<std::shared_ptr<SparseBytes>> SparseBytes::over(std::shared_ptr<const ByteSource> source)
{
  std::shared_ptr<SparseBytes> bytes(new SparseBytes);
  const auto size = static_cast<std::size_t>(source->bytes());
  if (size > 0)
  {
    void* const data = ::mmap(
      nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (data == MAP_FAILED)
    {
      return makeError(Error::Kind::NoMemory,
        "'" + source->path() + "': no addresses for its " + std::to_string(size) + " bytes");
    }
    bytes->data_ = static_cast<std::byte*>(data);
  }
  bytes->size_ = size;
  bytes->source_ = std::move(source);
  return bytes;
}

SparseBytes::~SparseBytes()
{
  if (data_ != nullptr)
  {
    ::munmap(data_, size_);
  }
}

Result<void> SparseBytes::want(const std::vector<HeldBytes::Part>& parts)
{
  std::vector<ByteRange> ranges;
  for (const HeldBytes::Part& part : parts)
  {
    const std::uint64_t begin = std::min<std::uint64_t>(part.offset, size_);
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(part.size, size_ - begin));
    wanted_ += size;
    if (size > 0)
    {
      ranges.push_back({ begin, size, data_ + begin });
    }
  }
  if (wanted_ > mostBytes)
  {
    return makeError(Error::Kind::NoMemory,
      "'" + source_->path() + "': its tables take more than " + std::to_string(mostBytes >> 20) +
        " MiB; build a store from a copy of it");
  }
  return ranges.empty() ? Result<void>() : source_->read(ranges.data(), ranges.size());
}

} // namespace pointfront
