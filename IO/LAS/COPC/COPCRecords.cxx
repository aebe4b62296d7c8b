#include "COPCRecords.h"

#include "pointfront/Threads/WorkBeside.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t blockBytes = std::size_t{ 1 } << 20;
constexpr std::size_t leastPointsInMemory = 4096;

Error cancelled(const std::string& folder)
{
  return makeError(Error::Kind::Cancelled, folder + ": export cancelled");
}
} // namespace

COPCRecords::COPCRecords(Options options)
  : options_(std::move(options))
{
  // A sort merges its two halves through half as much memory again.
  const std::size_t each = options_.recordBytes + sizeof(Slot) + sizeof(Slot) / 2;
  std::uint64_t points = options_.memoryBytes / each;
  points = options_.expected > 0 ? std::min(points, options_.expected) : points;
  pointsInMemory_ = static_cast<std::size_t>(std::clamp<std::uint64_t>(
    points, leastPointsInMemory, std::numeric_limits<std::int32_t>::max()));
}

Result<void> COPCRecords::append(const std::byte* records, std::size_t count)
{
  const std::size_t width = options_.recordBytes;
  while (count > 0)
  {
    const std::size_t has = memory_.size() / width;
    if (has == pointsInMemory_)
    {
      if (auto done = spill(); !done)
      {
        return done;
      }
      continue;
    }
    const std::size_t taken = std::min(count, pointsInMemory_ - has);
    // At once: a vector that grows has its old memory beside the new. What is not filled is not
    // used.
    memory_.reserve(pointsInMemory_ * width);
    memory_.insert(memory_.end(), records, records + taken * width);
    records += taken * width;
    count -= taken;
  }
  return {};
}

/// The records in memory become a run, not yet sorted: the cube is known when all points have come.
Result<void> COPCRecords::spill()
{
  if (!file_)
  {
    Result<std::unique_ptr<SpillFile>> file = SpillFile::create(options_.folder,
      std::max<std::uint64_t>(memory_.size(), options_.expected * options_.recordBytes));
    if (!file)
    {
      return file.error();
    }
    file_ = std::move(*file);
  }
  if (auto done = file_->write(fileBytes_, memory_.data(), memory_.size()); !done)
  {
    return done;
  }
  Run run;
  run.offset = fileBytes_;
  run.points = memory_.size() / options_.recordBytes;
  fileBytes_ += memory_.size();
  runs_.push_back(std::move(run));
  memory_.clear();
  return {};
}

void COPCRecords::sortMemory(const COPCGrid& grid)
{
  const std::size_t width = options_.recordBytes;
  const std::size_t points = memory_.size() / width;
  order_.resize(points);
  const auto less = [](const Slot& a, const Slot& b)
  { return a.key != b.key ? a.key < b.key : a.index < b.index; };
  const auto sortPart = [&](std::size_t first, std::size_t end)
  {
    for (std::size_t i = first; i < end; ++i)
    {
      order_[i] = { grid.key(memory_.data() + i * width), static_cast<std::uint32_t>(i) };
    }
    std::sort(order_.begin() + static_cast<std::ptrdiff_t>(first),
      order_.begin() + static_cast<std::ptrdiff_t>(end), less);
  };
  const std::size_t middle = points / 2;
  auto half = workBeside([&] { sortPart(0, middle); });
  sortPart(middle, points);
  half.get();
  std::inplace_merge(
    order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(middle), order_.end(), less);
  nextInMemory_ = 0;
}

/// A run comes into memory, and goes back in order.
Result<void> COPCRecords::sortRun(Run& run, const COPCGrid& grid)
{
  const std::size_t width = options_.recordBytes;
  memory_.resize(run.points * width);
  if (auto done = file_->read(run.offset, memory_.data(), memory_.size()); !done)
  {
    return done;
  }
  sortMemory(grid);
  std::vector<std::byte> block;
  block.reserve(blockBytes + width);
  std::uint64_t offset = run.offset;
  for (std::size_t i = 0; i < order_.size(); ++i)
  {
    const std::byte* record = memory_.data() + order_[i].index * width;
    block.insert(block.end(), record, record + width);
    if (block.size() >= blockBytes || i + 1 == order_.size())
    {
      if (auto done = file_->write(offset, block.data(), block.size()); !done)
      {
        return done;
      }
      offset += block.size();
      block.clear();
    }
  }
  return {};
}

Result<void> COPCRecords::sort(const COPCGrid& grid, const Advance& advance)
{
  grid_ = &grid;
  if (runs_.empty())
  {
    sortMemory(grid);
    return advance(order_.size()) ? Result<void>() : cancelled(options_.folder);
  }
  if (!memory_.empty())
  {
    if (auto done = spill(); !done)
    {
      return done;
    }
  }
  std::uint64_t sorted = 0;
  for (Run& run : runs_)
  {
    if (auto done = sortRun(run, grid); !done)
    {
      return done;
    }
    sorted += run.points;
    if (!advance(sorted))
    {
      return cancelled(options_.folder);
    }
  }
  // Assigning {} would keep what they have reserved.
  memory_ = std::vector<std::byte>();
  order_ = std::vector<Slot>();
  for (std::size_t run = 0; run < runs_.size(); ++run)
  {
    if (auto done = push(run); !done)
    {
      return done;
    }
  }
  return {};
}

Result<bool> COPCRecords::fill(Run& run)
{
  const std::size_t width = options_.recordBytes;
  if (run.at < run.buffer.size())
  {
    run.key = grid_->key(run.buffer.data() + run.at);
    return true;
  }
  const std::size_t share = options_.mergeBytes / runs_.size();
  const std::uint64_t points =
    std::min<std::uint64_t>(run.points - run.read, std::max<std::size_t>(1, share / width));
  if (points == 0)
  {
    run.buffer = std::vector<std::byte>();
    return false;
  }
  run.buffer.resize(points * width);
  if (auto done = file_->read(run.offset + run.read * width, run.buffer.data(), run.buffer.size());
      !done)
  {
    return done.error();
  }
  run.read += points;
  run.at = 0;
  run.key = grid_->key(run.buffer.data());
  return true;
}

Result<void> COPCRecords::push(std::size_t run)
{
  const Result<bool> has = fill(runs_[run]);
  if (!has)
  {
    return has.error();
  }
  if (*has)
  {
    heap_.emplace_back(runs_[run].key, run);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }
  return {};
}

Result<std::optional<COPCRecords::Record>> COPCRecords::next()
{
  const std::size_t width = options_.recordBytes;
  if (runs_.empty())
  {
    if (nextInMemory_ == order_.size())
    {
      return std::optional<Record>();
    }
    const Slot& place = order_[nextInMemory_++];
    return std::optional<Record>(Record{ place.key, memory_.data() + place.index * width });
  }
  if (given_)
  {
    runs_[*given_].at += width;
    if (auto done = push(*std::exchange(given_, std::nullopt)); !done)
    {
      return done.error();
    }
  }
  if (heap_.empty())
  {
    return std::optional<Record>();
  }
  std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
  given_ = heap_.back().second;
  heap_.pop_back();
  const Run& run = runs_[*given_];
  return std::optional<Record>(Record{ run.key, run.buffer.data() + run.at });
}

} // namespace pointfront
