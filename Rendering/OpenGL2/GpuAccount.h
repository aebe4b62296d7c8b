#pragma once

#include <cstdint>
#include <vector>

namespace pointfront
{

class GpuPool;

/// GPU memory of all clouds of a window: what their pools have together, so that a budget of bytes
/// holds for the window whichever of them has it.
/// Threads  that of the GL context.
class GpuAccount
{
public:
  void join(GpuPool& pool);
  void leave(GpuPool& pool);
  void charge(std::int64_t bytes) { bytes_ += bytes; }
  std::int64_t bytes() const { return bytes_; }
  /// The others give back what nobody draws until they are `bytes` fewer, if they can.
  void reclaim(std::int64_t bytes, const GpuPool& asking);

private:
  std::vector<GpuPool*> pools_;
  std::int64_t bytes_ = 0;
};

} // namespace pointfront
