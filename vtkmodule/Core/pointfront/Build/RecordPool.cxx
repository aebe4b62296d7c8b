#include "pointfront/Build/RecordPool.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <sys/mman.h>

namespace pointfront
{
namespace
{
constexpr std::size_t largePageBytes = std::size_t(2) << 20;
} // namespace

std::unique_ptr<RecordPool> RecordPool::inMemory(std::uint64_t capacity, std::size_t recordBytes)
{
  std::unique_ptr<RecordPool> pool(new RecordPool(recordBytes));
  const std::size_t bytes = capacity * recordBytes;
  // Not zeroed: pages come when used. In large ones: a small one costs as much to take as to fill.
  const std::size_t rounded = (bytes + largePageBytes - 1) / largePageBytes * largePageBytes;
  pool->memory_.reset(
    static_cast<std::byte*>(std::aligned_alloc(largePageBytes, std::max(rounded, largePageBytes))));
  if (!pool->memory_)
  {
    throw std::bad_alloc(); // as every other container of the build
  }
  if (bytes >= largePageBytes)
  {
    madvise(pool->memory_.get(), bytes / largePageBytes * largePageBytes, MADV_HUGEPAGE); // a hint
  }
  return pool;
}

Result<std::unique_ptr<RecordPool>> RecordPool::spilled(
  const std::string& folder, std::uint64_t capacity, std::size_t recordBytes)
{
  auto file = SpillFile::create(folder, capacity * recordBytes);
  if (!file)
  {
    return file.error();
  }
  std::unique_ptr<RecordPool> pool(new RecordPool(recordBytes));
  pool->file_ = std::move(*file);
  return pool;
}

Result<void> RecordPool::write(std::uint64_t first, std::uint64_t count, const std::byte* records)
{
  if (count == 0)
  {
    return {};
  }
  if (file_)
  {
    return file_->write(first * recordBytes_, records, count * recordBytes_);
  }
  std::memcpy(memory_.get() + first * recordBytes_, records, count * recordBytes_);
  return {};
}

Result<void> RecordPool::read(std::uint64_t first, std::uint64_t count, std::byte* records) const
{
  if (count == 0)
  {
    return {};
  }
  if (file_)
  {
    return file_->read(first * recordBytes_, records, count * recordBytes_);
  }
  std::memcpy(records, memory_.get() + first * recordBytes_, count * recordBytes_);
  return {};
}

} // namespace pointfront
