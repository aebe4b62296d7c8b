#include "pointfront/Disk/LatePieces.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{

Result<void> LatePieces::append(const std::byte* data, std::size_t size)
{
  assert(!places_.empty());
  if (!file_)
  {
    auto file = SpillFile::create(folder_, 0, SpillFile::Way::ThroughCache);
    if (!file)
    {
      return file.error();
    }
    file_ = std::move(*file);
  }
  Result<void> done = file_->write(end_, data, size);
  end_ += size;
  places_.back().bytes += size;
  return done;
}

Result<std::vector<std::byte>> LatePieces::read(std::uint32_t number) const
{
  const Place* place = find(number);
  assert(place);
  return read(number, 0, place->bytes);
}

Result<std::vector<std::byte>> LatePieces::read(
  std::uint32_t number, std::uint64_t begin, std::size_t size) const
{
  const Place* place = find(number);
  assert(place && begin <= place->bytes && size <= place->bytes - begin);
  std::vector<std::byte> bytes(size);
  const Result<void> done = file_->read(place->offset + begin, bytes.data(), size);
  return done ? Result<std::vector<std::byte>>(std::move(bytes)) : done.error();
}

const LatePieces::Place* LatePieces::find(std::uint32_t number) const
{
  const auto place = std::lower_bound(places_.begin(), places_.end(), number,
    [](const Place& p, std::uint32_t wanted) { return p.number < wanted; });
  return place != places_.end() && place->number == number ? &*place : nullptr;
}

} // namespace pointfront
