#include "LZFDecoder.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace pointfront
{
namespace
{
constexpr std::size_t history = 8192; // as far as a copy reaches back
constexpr std::size_t pieceBytes = 1 << 20; // handed on at once
constexpr std::size_t longestRun = 264;

Error corrupt(std::size_t at, const char* what)
{
  return makeError(Error::Kind::Corrupt,
    "the LZF block is damaged at its byte " + std::to_string(at) + ": " + what);
}

/// The unpacked bytes that are not yet handed on, behind the last bytes that are.
class Window
{
public:
  explicit Window(const std::function<Result<void>(const std::byte*, std::size_t)>& write)
    : write_(write)
    , bytes_(history + pieceBytes + longestRun)
  {
  }
  std::uint64_t total() const { return handedOn_ + (end_ - begin_); }
  std::size_t reach() const { return end_; }
  void append(const std::byte* from, std::size_t count)
  {
    std::memcpy(bytes_.data() + end_, from, count);
    end_ += count;
  }
  /// Byte by byte: a copy may overlap itself.
  void repeat(std::size_t distance, std::size_t count)
  {
    std::byte* to = bytes_.data() + end_;
    const std::byte* from = to - distance;
    for (std::size_t i = 0; i < count; ++i)
    {
      to[i] = from[i];
    }
    end_ += count;
  }
  Result<void> makeRoom() { return end_ - begin_ >= pieceBytes ? flush() : Result<void>(); }
  Result<void> flush()
  {
    if (Result<void> done = write_(bytes_.data() + begin_, end_ - begin_); !done)
    {
      return done;
    }
    handedOn_ += end_ - begin_;
    const std::size_t kept = std::min(end_, history);
    std::memmove(bytes_.data(), bytes_.data() + end_ - kept, kept);
    begin_ = end_ = kept;
    return {};
  }

private:
  const std::function<Result<void>(const std::byte*, std::size_t)>& write_;
  std::vector<std::byte> bytes_;
  std::size_t begin_ = 0; ///< offset of the first byte that is not handed on
  std::size_t end_ = 0;
  std::uint64_t handedOn_ = 0;
};
} // namespace

Result<void> decodeLZF(const std::byte* block, std::size_t blockBytes, std::uint64_t outputBytes,
  const std::function<Result<void>(const std::byte*, std::size_t)>& write)
{
  Window window(write);
  std::size_t at = 0;
  const auto next = [&] { return std::to_integer<std::size_t>(block[at++]); };
  while (at < blockBytes)
  {
    if (Result<void> room = window.makeRoom(); !room)
    {
      return room;
    }
    const std::size_t start = at;
    const std::size_t control = next();
    const std::uint64_t left = outputBytes - window.total();
    if (control < 32) // a literal run
    {
      const std::size_t count = control + 1;
      if (count > blockBytes - at)
      {
        return corrupt(start, "it ends inside a run of literal bytes");
      }
      if (count > left)
      {
        return corrupt(start, "it unpacks to more than it says");
      }
      window.append(block + at, count);
      at += count;
      continue;
    }
    std::size_t count = control >> 5;
    if (blockBytes - at < (count == 7 ? 2u : 1u))
    {
      return corrupt(start, "it ends inside a reference");
    }
    count += count == 7 ? next() : 0;
    count += 2;
    const std::size_t distance = ((control & 31) << 8) + next() + 1;
    if (distance > window.reach())
    {
      return corrupt(start, "it refers to bytes before its beginning");
    }
    if (count > left)
    {
      return corrupt(start, "it unpacks to more than it says");
    }
    window.repeat(distance, count);
  }
  if (window.total() != outputBytes)
  {
    return corrupt(at, "it unpacks to less than it says");
  }
  return window.flush();
}

} // namespace pointfront
