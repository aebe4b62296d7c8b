#pragma once

#include <cstddef>
#include <vector>

namespace pointfront
{

/// The vertices that a frame draws of the blocks of a pool: runs in an order that does not depend
/// on their places in the pool. So a view looks the same in whatever way its points came to the
/// GPU, even where points fall on one pixel at one depth.
class DrawRuns
{
public:
  /// Neighbouring runs of one block.
  struct Stretch
  {
    std::size_t block;
    std::size_t begin; ///< number of the first run
    std::size_t end;
  };

  void clear()
  {
    firsts_.clear();
    counts_.clear();
    stretches_.clear();
  }
  /// `count` vertices from `first` on, in `block`.
  void add(std::size_t block, int first, int count)
  {
    const bool same = !stretches_.empty() && stretches_.back().block == block;
    if (same && firsts_.back() + counts_.back() == first)
    {
      counts_.back() += count;
      return;
    }
    if (!same)
    {
      stretches_.push_back({ block, firsts_.size(), firsts_.size() });
    }
    firsts_.push_back(first);
    counts_.push_back(count);
    stretches_.back().end = firsts_.size();
  }

  const std::vector<Stretch>& stretches() const { return stretches_; }
  const int* firsts() const { return firsts_.data(); }
  const int* counts() const { return counts_.data(); }

private:
  std::vector<int> firsts_;
  std::vector<int> counts_;
  std::vector<Stretch> stretches_;
};

} // namespace pointfront
