#include "pointfront/InPlace/RunList.h"

#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
/// No file has as many points; a number beyond is damage.
constexpr std::uint64_t largestNumber = std::uint64_t(1) << 60;
constexpr unsigned bitsPerByte = 7;
} // namespace

void RunListWriter::put(std::uint64_t value)
{
  for (; value >= 0x80; value >>= bitsPerByte)
  {
    bytes_.push_back(static_cast<std::byte>(value | 0x80));
  }
  bytes_.push_back(static_cast<std::byte>(value));
}

void RunListWriter::add(const Run& run)
{
  assert(run.count > 0 && run.first >= pending_.first + pending_.count);
  if (pending_.count > 0 && run.first == pending_.first + pending_.count)
  {
    pending_.count += run.count;
    return;
  }
  finish();
  pending_ = run;
}

void RunListWriter::finish()
{
  if (pending_.count == 0)
  {
    return;
  }
  put(2 * (pending_.first - end_) + (pending_.count > 1 ? 1 : 0));
  if (pending_.count > 1)
  {
    put(pending_.count - 2);
  }
  end_ = pending_.first + pending_.count;
  pending_ = Run{ end_, 0 };
  ++runs_;
}

std::vector<std::byte> RunListWriter::take()
{
  return std::exchange(bytes_, {});
}

bool RunListReader::get(std::uint64_t& value)
{
  value = 0;
  for (unsigned shift = 0; at_ != last_ && shift < 9 * bitsPerByte; shift += bitsPerByte)
  {
    const auto byte = std::to_integer<std::uint64_t>(*at_++);
    value |= (byte & 0x7f) << shift;
    if (byte < 0x80)
    {
      return true;
    }
  }
  sound_ = false;
  return false;
}

bool RunListReader::next(Run& run)
{
  std::uint64_t gap = 0;
  if (!sound_ || at_ == last_ || !get(gap))
  {
    return false;
  }
  std::uint64_t more = 0;
  if ((gap & 1) != 0)
  {
    if (!get(more))
    {
      return false;
    }
    ++more;
  }
  sound_ = (gap >> 1) < largestNumber && more < largestNumber && end_ < largestNumber;
  run = Run{ end_ + (gap >> 1), more + 1 };
  end_ = run.first + run.count;
  return sound_;
}

} // namespace pointfront
