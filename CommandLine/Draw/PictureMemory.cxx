#include "PictureMemory.h"

#include <algorithm>
#include <string>

namespace pointfront
{

namespace
{
/// Fewer rows than the margins have cost more than they draw: rather fewer threads.
constexpr int leastRowsOfSeveral = 128;

/// The most that a whole frame may take: the rest is for points, or there is nothing to see.
std::uint64_t mostOfFrames(std::uint64_t budgetBytes)
{
  return budgetBytes - budgetBytes / 4;
}
} // namespace

std::uint64_t PictureMemory::bytesOfRows(int rows, unsigned threads) const
{
  const auto width = static_cast<std::uint64_t>(size_[0]);
  const auto height = static_cast<std::uint64_t>(rows);
  const auto margins = 2 * static_cast<std::uint64_t>(cost_.marginPixels);
  return cost_.pixelBytes * width * height +
    threads * cost_.threadPixelBytes * (width + margins) * (height + margins);
}

std::int64_t PictureMemory::rowsThatFit(unsigned threads) const
{
  const std::uint64_t margins = bytesOfRows(0, threads);
  const std::uint64_t row = bytesOfRows(1, threads) - margins;
  const std::uint64_t half = budgetBytes_ / 2;
  const std::uint64_t drawn = half > margins ? (half - margins) / row : 0;
  return static_cast<std::int64_t>(drawn) - 2 * cost_.overlapRows;
}

Result<PictureMemory> PictureMemory::share(
  std::array<int, 2> size, std::uint64_t budgetBytes, const PictureCost& cost)
{
  PictureMemory memory;
  memory.size_ = size;
  memory.budgetBytes_ = budgetBytes;
  memory.cost_ = cost;
  memory.bandThreads_ = cost.threads;
  memory.bandRows_ = size[1];
  memory.frameThreads_ = std::max(1u, cost.threads);
  while (memory.frameThreads_ > 1 && memory.frameBytes() > mostOfFrames(budgetBytes))
  {
    --memory.frameThreads_;
  }
  if (memory.bytesOfRows(size[1], cost.threads) <= budgetBytes / 2)
  {
    return memory;
  }
  unsigned& threads = memory.bandThreads_;
  while (threads > 1 && memory.rowsThatFit(threads) < std::min(leastRowsOfSeveral, size[1]))
  {
    threads /= 2;
  }
  const std::int64_t rows = memory.rowsThatFit(threads);
  if (rows < 1)
  {
    const int least = std::min(1 + 2 * cost.overlapRows, size[1]);
    return makeError(Error::Kind::NoMemory,
      "a picture of " + std::to_string(size[0]) + " pixels across takes --memory " +
        std::to_string(2 * memory.bytesOfRows(least, 1)) + " at least, and it is " +
        std::to_string(budgetBytes));
  }
  memory.bandRows_ = static_cast<int>(std::min<std::int64_t>(rows, size[1]));
  return memory;
}

Result<void> PictureMemory::checkFrame() const
{
  if (frameBytes() <= mostOfFrames(budgetBytes_))
  {
    return {};
  }
  return makeError(Error::Kind::NoMemory,
    "a frame of " + std::to_string(size_[0]) + " x " + std::to_string(size_[1]) +
      " pixels takes --memory " + std::to_string(frameBytes() + (frameBytes() - 1) / 3) +
      " at least, and it is " + std::to_string(budgetBytes_));
}

std::uint64_t PictureMemory::bandBytes() const
{
  return bytesOfRows(std::min(bandRows_ + 2 * cost_.overlapRows, size_[1]), bandThreads_);
}

std::uint64_t PictureMemory::pointBytesOfFrames() const
{
  return budgetBytes_ - std::min(frameBytes(), mostOfFrames(budgetBytes_));
}

} // namespace pointfront
