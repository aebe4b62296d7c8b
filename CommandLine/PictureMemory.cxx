#include "PictureMemory.h"

#include <algorithm>
#include <string>

namespace pointfront
{

Result<PictureMemory> PictureMemory::share(std::array<int, 2> size, std::uint64_t budgetBytes,
  std::uint64_t pixelBytes, int overlapRows)
{
  PictureMemory memory;
  memory.budgetBytes_ = budgetBytes;
  memory.rowBytes_ = pixelBytes * static_cast<std::uint64_t>(size[0]);
  memory.rows_ = size[1];
  memory.bandRows_ = size[1];
  memory.overlapRows_ = overlapRows;
  if (memory.bytesOfRows(size[1]) > budgetBytes / 2)
  {
    const auto rows = static_cast<std::int64_t>(budgetBytes / 4 / memory.rowBytes_);
    const std::int64_t own = rows - 2 * overlapRows;
    memory.bandRows_ = static_cast<int>(std::clamp<std::int64_t>(own, 1, size[1]));
  }
  const int drawnRows = std::min(memory.bandRows_ + 2 * overlapRows, size[1]);
  if (memory.bytesOfRows(drawnRows) > budgetBytes / 2)
  {
    return makeError(Error::Kind::NoMemory,
      "--memory " + std::to_string(budgetBytes) + " is too small for a picture of " +
        std::to_string(size[0]) + " pixels across: " + std::to_string(drawnRows) +
        " rows of it take " + std::to_string(memory.bytesOfRows(drawnRows)) + " bytes; give twice "
        "that");
  }
  return memory;
}

std::uint64_t PictureMemory::pointBytesOfFrames() const
{
  return budgetBytes_ - std::min(bytesOfRows(rows_), budgetBytes_ / 2);
}

std::uint64_t PictureMemory::pointBytesOfBands() const
{
  return budgetBytes_ - bytesOfRows(std::min(bandRows_ + 2 * overlapRows_, rows_));
}

} // namespace pointfront
