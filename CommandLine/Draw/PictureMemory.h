#pragma once

#include "pointfront/Base/Result.h"

#include <array>
#include <cstdint>

namespace pointfront
{

/// The memory that drawing takes, for each pixel and for each thread.
struct PictureCost
{
  std::uint64_t pixelBytes = 0; ///< for the picture, whatever threads there are
  std::uint64_t threadPixelBytes = 0; ///< for the buffers of each thread
  int marginPixels = 0; ///< around the drawn part, on all sides, in each thread's buffers
  int overlapRows = 0; ///< rows of its neighbours that a band draws on each side
  unsigned threads = 1; ///< that draw, at most
};

/// How one limit of memory is shared between the picture, with all that drawing it needs, and the
/// decoded points. A complete picture that would take more than half is drawn in bands that do not,
/// by so many threads that their buffers leave room for rows. Frames that follow each other are
/// whole and may take three quarters: by as many threads as fit, and none where one does not.
/// Threads  a value.
class PictureMemory
{
public:
  /// `budgetBytes`: for both.
  /// Errors  NoMemory: not even a band of one row fits.
  static Result<PictureMemory> share(
    std::array<int, 2> size, std::uint64_t budgetBytes, const PictureCost& cost);

  std::uint64_t budgetBytes() const { return budgetBytes_; }
  /// Rows of a band of a complete picture, without its overlap; all where the picture fits.
  int bandRows() const { return bandRows_; }
  bool needsBands() const { return bandRows_ < size_[1]; }
  /// That draw a band.
  unsigned bandThreads() const { return bandThreads_; }
  int overlapRows() const { return cost_.overlapRows; }
  std::uint64_t frameBytes() const { return bytesOfRows(size_[1], frameThreads_); }
  /// That draw a whole frame; at least one.
  unsigned frameThreads() const { return frameThreads_; }
  /// Errors  NoMemory: a whole frame takes more than three quarters, by one thread as well.
  Result<void> checkFrame() const;
  std::uint64_t bandBytes() const;
  /// For points beside a whole picture; beside a band.
  std::uint64_t pointBytesOfFrames() const;
  std::uint64_t pointBytesOfBands() const { return budgetBytes_ - bandBytes(); }

private:
  PictureMemory() = default;
  std::uint64_t bytesOfRows(int rows, unsigned threads) const;
  /// Most rows that take no more than half of the budget; 0 or less: none.
  std::int64_t rowsThatFit(unsigned threads) const;

  std::array<int, 2> size_{};
  std::uint64_t budgetBytes_ = 0;
  PictureCost cost_;
  int bandRows_ = 0;
  unsigned bandThreads_ = 1;
  unsigned frameThreads_ = 1;
};

} // namespace pointfront
