#pragma once

#include "LargePages.h"
#include "RasterBatch.h"

#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace pointfront
{

/// Memory that is written before it is read; kept when it is large enough.
template <typename T>
class RasterBuffer
{
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_copyable_v<T>);

public:
  RasterBuffer() = default;
  RasterBuffer(RasterBuffer&& other) noexcept
    : data_(std::move(other.data_))
    , size_(std::exchange(other.size_, 0))
  {
  }
  RasterBuffer& operator=(RasterBuffer&& other) noexcept
  {
    data_ = std::move(other.data_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  T* ofSize(std::int64_t count)
  {
    const auto wanted = static_cast<std::size_t>(count);
    if (wanted > size_)
    {
      data_.reset();
      data_.reset(static_cast<T*>(allocateInLargePages(wanted * sizeof(T))));
      size_ = wanted;
    }
    return data_.get();
  }
  T* data() const { return data_.get(); }
  std::size_t bytes() const { return size_ * sizeof(T); }
  void release()
  {
    data_.reset();
    size_ = 0;
  }

private:
  std::unique_ptr<T[], FreesMemory> data_;
  std::size_t size_ = 0;
};

/// Sums of a refining view forget what lies that many pixels' size behind what came.
constexpr float forgottenPixels = 8.0f;

/// The second pass of blended splats: what was added up, for the next picture to go on from.
struct BlendedSums
{
  RasterBuffer<std::uint32_t> sums; ///< as ThreadBuffers'
  RasterBuffer<float> depths; ///< nearest ones, by which it was decided what is added
  /// They are those of one go. Else some have, or lack, what a nearer splat has hidden since.
  bool exact = false;
};

/// A pixel and the point that won it.
struct Winner
{
  std::int32_t x; ///< in the window
  std::int32_t y;
  std::uint32_t index; ///< in its node
  float keyDepth;
};

/// Winners of some rows, put in the order of their items: scratch of one thread.
struct WinnerLists
{
  RasterBuffer<Winner> found; ///< as they lie in the picture
  RasterBuffer<std::uint32_t> item; ///< item of each that was found
  std::size_t count = 0; ///< number of items
  RasterBuffer<Winner> sorted; ///< by item
  std::vector<std::uint32_t> places; ///< places of each item: how many, then where; 0 between uses
  std::vector<std::uint32_t> touched; ///< items with a winner, in the order they were found
};

/// The buffers that one thread draws into.
struct ThreadBuffers
{
  RasterBuffer<RasterKey> keys;
  RasterBuffer<std::uint32_t> sums; ///< weight * r, g, b and weight of each pixel
  std::unique_ptr<RasterBatch> batch;
  WinnerLists winners;
  bool keysDrawn = false; ///< cleared, and maybe drawn into, in this picture
  bool sumsDrawn = false;

  RasterBatch& scratch()
  {
    if (!batch)
    {
      batch = std::make_unique<RasterBatch>();
    }
    return *batch;
  }
};

} // namespace pointfront
