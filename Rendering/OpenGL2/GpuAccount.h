#pragma once

#include <cstdint>
#include <vector>

namespace pointfront
{

class GpuPool;

/// GPU memory of all clouds of a window: what their pools have together, so that a budget of bytes
/// holds for the window whichever of them has it.
/// Rounds   in which each pool is drawn once; the first to be drawn again begins the next. In one
///          that found the budget lowered, what is not drawn yet makes room for what is: so the
///          lower budget holds in the first frame, before anything is drawn.
/// Threads  that of the GL context.
class GpuAccount
{
public:
  void join(GpuPool& pool);
  void leave(GpuPool& pool);
  /// The pool draws now. `lowered`: its budget is less than in the frame before, and exceeded.
  void draw(const GpuPool& pool, bool lowered);
  void charge(std::int64_t bytes) { bytes_ += bytes; }
  std::int64_t bytes() const { return bytes_; }
  /// The others give back what nobody draws until they are `bytes` fewer, if they can; in a round
  /// with a lowered budget also what the frame before showed of pools that are yet to be drawn.
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
