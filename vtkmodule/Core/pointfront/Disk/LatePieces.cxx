#include "pointfront/Disk/LatePieces.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{

Result<void> LatePieces::append(const std::vector<std::byte>& bytes)
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
  Result<void> done = file_->write(end_, bytes.data(), bytes.size());
  end_ += bytes.size();
  places_.back().bytes += bytes.size();
  return done;
}

Result<std::vector<std::byte>> LatePieces::read(std::uint32_t number) const
{
  const Place* place = find(number);
  assert(place);
  std::vector<std::byte> bytes(place->bytes);
  const Result<void> done = file_->read(place->offset, bytes.data(), bytes.size());
  return done ? Result<std::vector<std::byte>>(std::move(bytes)) : done.error();
}

const LatePieces::Place* LatePieces::find(std::uint32_t number) const
{
  const auto place = std::lower_bound(places_.begin(), places_.end(), number,
    [](const Place& p, std::uint32_t wanted) { return p.number < wanted; });
  return place != places_.end() && place->number == number ? &*place : nullptr;
}

} // namespace pointfront
