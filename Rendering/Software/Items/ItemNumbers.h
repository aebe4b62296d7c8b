#pragma once

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Numbers of the points of a frame: those of each item follow the item's before.
class ItemNumbers
{
public:
  /// The next item has that many points.
  void append(std::uint32_t points)
  {
    ends_.push_back(end() + points);
    const auto item = static_cast<std::uint32_t>(ends_.size() - 1);
    while ((std::uint64_t(pages_.size()) << pageBits) < ends_.back())
    {
      pages_.push_back(item);
    }
  }
  /// The item that has a number below end().
  std::uint32_t itemOf(std::uint32_t number) const
  {
    std::uint32_t item = pages_[number >> pageBits];
    while (number >= ends_[item])
    {
      ++item;
    }
    return item;
  }
  std::uint32_t beginOf(std::uint32_t item) const { return item == 0 ? 0 : ends_[item - 1]; }
  std::uint32_t endOf(std::uint32_t item) const { return ends_[item]; }
  std::uint32_t end() const { return ends_.empty() ? 0 : ends_.back(); }

private:
  static constexpr unsigned pageBits = 9;
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> pages_; ///< the item that has a page's first number
};

} // namespace pointfront
