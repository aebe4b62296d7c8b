#pragma once

#include <cstdint>
#include <vector>

namespace pointfront
{

class GpuPool;

/// The GPU memory that the pools of all clouds of a window have together, so that a budget of bytes
/// holds for the window.
/// Rounds   each pool is drawn once in a round; the first pool that is drawn again begins the next
///          round. In a round with a lowered budget, pools that are not drawn yet make room for the
///          others, so the lower budget holds in the first frame.
/// Threads  that of the GL context.
class GpuAccount
{
public:
  void join(GpuPool& pool);
  void leave(GpuPool& pool);
  /// Tells that the pool draws now. `lowered`: its budget is less than in the frame before, and
  /// exceeded.
  void draw(const GpuPool& pool, bool lowered);
  void charge(std::int64_t bytes) { bytes_ += bytes; }
  std::int64_t bytes() const { return bytes_; }
  /// Makes the other pools give back nodes that nobody draws, up to `bytes` bytes. In a round with
  /// a lowered budget, pools that are yet to be drawn also give back nodes that the frame before
  /// showed.
  void reclaim(std::int64_t bytes, const GpuPool& asking);

private:
  struct Member
  {
    GpuPool* pool;
    bool drawn; ///< in this round
  };
  std::vector<Member> members_;
  bool lowered_ = false; ///< in this round
  std::int64_t bytes_ = 0;
};

} // namespace pointfront
