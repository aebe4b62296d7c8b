#pragma once

#include "RasterBatch.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Memory that is written before it is read; kept when it is large enough.
template <typename T>
class RasterBuffer
{
public:
  T* ofSize(std::int64_t count)
  {
    const auto wanted = static_cast<std::size_t>(count);
    if (wanted > size_)
    {
      data_.reset();
      data_ = std::unique_ptr<T[]>(new T[wanted]);
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
  std::unique_ptr<T[]> data_;
  std::size_t size_ = 0;
};

/// What one thread draws into.
struct ThreadBuffers
{
  RasterBuffer<RasterKey> keys;
  RasterBuffer<std::uint32_t> sums; ///< weight * r, g, b and weight of each pixel
  std::unique_ptr<RasterBatch> batch;
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
