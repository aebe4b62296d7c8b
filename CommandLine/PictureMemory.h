#pragma once

#include "pointfront/Base/Result.h"

#include <array>
#include <cstdint>

namespace pointfront
{

/// How one limit of memory is shared between the picture, with all that drawing it needs, and the
/// decoded points: a complete picture that would take more than half is drawn in bands that take a
/// quarter. Frames that follow each other are whole, whatever they take; the points then have half.
/// Threads  a value.
class PictureMemory
{
public:
  /// `budgetBytes`: for both. `pixelBytes`: that a pixel takes while it is drawn. `overlapRows`:
  /// that a band needs of its neighbours on each side.
  /// Errors  NoMemory: not even a band of one row fits.
  static Result<PictureMemory> share(std::array<int, 2> size, std::uint64_t budgetBytes,
    std::uint64_t pixelBytes, int overlapRows);

  std::uint64_t budgetBytes() const { return budgetBytes_; }
  /// Rows of a band of a complete picture, without its overlap; all where the picture fits.
  int bandRows() const { return bandRows_; }
  int overlapRows() const { return overlapRows_; }
  std::uint64_t bytesOfRows(int rows) const { return rowBytes_ * static_cast<std::uint64_t>(rows); }
  /// For points beside a whole picture; beside a band.
  std::uint64_t pointBytesOfFrames() const;
  std::uint64_t pointBytesOfBands() const;

private:
  PictureMemory() = default;

  std::uint64_t budgetBytes_ = 0;
  std::uint64_t rowBytes_ = 0;
  int rows_ = 0;
  int bandRows_ = 0;
  int overlapRows_ = 0;
};

} // namespace pointfront
