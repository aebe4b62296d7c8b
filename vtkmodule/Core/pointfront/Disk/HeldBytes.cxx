#include "pointfront/Disk/HeldBytes.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace pointfront
{

HeldBytes::HeldBytes(std::shared_ptr<const ByteSource> source)
  : ByteSource(source->path(), source->bytes())
  , source_(std::move(source))
{
}

Result<std::shared_ptr<const ByteSource>> HeldBytes::hold(
  std::shared_ptr<const ByteSource> source, const std::vector<Part>& parts)
{
  std::shared_ptr<HeldBytes> bytes(new HeldBytes(std::move(source)));
  std::vector<ByteRange> ranges;
  for (const Part& part : parts)
  {
    if (part.size > 0)
    {
      bytes->held_.push_back({ part.offset, RawBytes(part.size) });
      ranges.push_back({ part.offset, part.size, bytes->held_.back().bytes.data.get() });
    }
  }
  if (Result<void> done = bytes->source_->read(ranges.data(), ranges.size()); !done)
  {
    return done.error();
  }
  return std::shared_ptr<const ByteSource>(std::move(bytes));
}

const std::byte* HeldBytes::find(std::uint64_t offset, std::size_t size) const
{
  for (const Held& held : held_)
  {
    const std::uint64_t from = offset - held.offset;
    if (offset >= held.offset && from <= held.bytes.size && size <= held.bytes.size - from)
    {
      return held.bytes.data.get() + from;
    }
  }
  return nullptr;
}

bool HeldBytes::copy(const ByteRange& range) const
{
  const std::byte* held = find(range.offset, range.size);
  if (held != nullptr)
  {
    std::memcpy(range.target, held, range.size);
  }
  return held != nullptr;
}

std::vector<ByteRange> HeldBytes::copyHeld(const ByteRange* ranges, std::size_t count) const
{
  std::vector<ByteRange> left;
  std::copy_if(ranges, ranges + count, std::back_inserter(left),
    [this](const ByteRange& range) { return range.size > 0 && !copy(range); });
  return left;
}

Result<void> HeldBytes::read(const ByteRange* ranges, std::size_t count) const
{
  const std::vector<ByteRange> left = copyHeld(ranges, count);
  return left.empty() ? Result<void>() : source_->read(left.data(), left.size());
}

Result<void> HeldBytes::readUntil(
  const ReadStop& stop, const ByteRange* ranges, std::size_t count) const
{
  const std::vector<ByteRange> left = copyHeld(ranges, count);
  return left.empty() ? Result<void>() : source_->readUntil(stop, left.data(), left.size());
}

} // namespace pointfront
