#include "pointfront/Records/RecordPool.h"

#include <cstring>

namespace pointfront
{

std::unique_ptr<RecordPool> RecordPool::inMemory(std::uint64_t capacity, std::size_t recordBytes)
{
  std::unique_ptr<RecordPool> pool(new RecordPool(recordBytes));
  pool->memory_.reset(new std::byte[capacity * recordBytes]); // not zeroed: pages come when used
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
