#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// `count` consecutive numbers from `first` on.
struct Run
{
  std::uint64_t first = 0;
  std::uint64_t count = 0;

  friend bool operator==(const Run& a, const Run& b)
  {
    return a.first == b.first && a.count == b.count;
  }
};

/// Ascending runs as bytes, made while they are found.
/// Coding   for each run v(2 * gap + (count > 1 ? 1 : 0)) and, if count > 1, v(count - 2); gap is
///          the distance from the end of the run before (from 0 at first); v() writes 7 bits a
///          byte, lowest first, the top bit set on all but the last.
/// Size     n numbers out of N in the worst order take n (1 + log128(N / n)) bytes at most and
///          about: two or three bytes each for ten thousand numbers of a billion.
class RunListWriter
{
public:
  /// `run` begins at or behind the end of the last one; it is joined with it where they touch.
  void add(const Run& run);
  /// Codes the run that is still held back because the next might have touched it.
  void finish();

  std::uint64_t runCount() const { return runs_; } ///< coded so far
  const std::vector<std::byte>& bytes() const { return bytes_; }
  /// Gives the bytes coded so far away, and the memory with them; coding goes on behind them.
  std::vector<std::byte> take();

private:
  void put(std::uint64_t value);

  std::vector<std::byte> bytes_;
  Run pending_;
  std::uint64_t end_ = 0; ///< end of the last run coded
  std::uint64_t runs_ = 0;
};

/// Decodes a list of runs from bytes that may be damaged.
class RunListReader
{
public:
  RunListReader(const std::byte* data, std::size_t size)
    : at_(data)
    , last_(data + size)
  {
  }
  /// The next run. False at the end, and from the first fault on.
  bool next(Run& run);
  /// False when the bytes are no list: a number that is cut off or overflows.
  bool sound() const { return sound_; }

private:
  bool get(std::uint64_t& value);

  const std::byte* at_;
  const std::byte* last_;
  std::uint64_t end_ = 0;
  bool sound_ = true;
};

} // namespace pointfront
