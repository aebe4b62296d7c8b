#include "pointfront/Front/DrawOrder.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{

/// Below that comparing is faster than clearing the counts.
constexpr std::size_t fewItems = 400;

bool nearer(const DrawItem& a, const DrawItem& b)
{
  return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
}

std::uint32_t bitsOf(float distance)
{
  distance += 0.0f; // a zero without a sign
  std::uint32_t bits = 0;
  std::memcpy(&bits, &distance, sizeof(bits));
  return bits;
}

void sortTies(std::vector<DrawItem>& items)
{
  const auto byNode = [](const DrawItem& a, const DrawItem& b) { return a.node < b.node; };
  for (std::size_t begin = 0; begin < items.size();)
  {
    std::size_t end = begin + 1;
    while (end < items.size() && items[end].distance == items[begin].distance)
    {
      ++end;
    }
    if (end - begin > 1)
    {
      std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
        items.begin() + static_cast<std::ptrdiff_t>(end), byNode);
    }
    begin = end;
  }
}

} // namespace

void DrawOrder::scatter(
  const std::vector<DrawItem>& from, std::size_t digit, std::vector<DrawItem>& to)
{
  const std::size_t shift = digit * digitBits;
  Counts& places = counts_[digit];
  std::uint32_t before = 0;
  for (std::uint32_t& count : places)
  {
    const std::uint32_t own = count;
    count = before;
    before += own;
  }
  for (const DrawItem& item : from)
  {
    to[places[bitsOf(item.distance) >> shift & (values - 1)]++] = item;
  }
}

void DrawOrder::sort(std::vector<DrawItem>& items)
{
  if (items.size() < fewItems)
  {
    std::sort(items.begin(), items.end(), nearer);
    return;
  }
  for (Counts& counts : counts_)
  {
    counts.fill(0);
  }
  for (const DrawItem& item : items)
  {
    const std::uint32_t bits = bitsOf(item.distance);
    for (std::size_t d = 0; d < digits; ++d)
    {
      ++counts_[d][bits >> (d * digitBits) & (values - 1)];
    }
  }
  other_.resize(items.size());
  std::vector<DrawItem>* from = &items;
  std::vector<DrawItem>* to = &other_;
  for (std::size_t d = 0; d < digits; ++d)
  {
    const std::uint32_t any = bitsOf(items.front().distance) >> (d * digitBits) & (values - 1);
    if (counts_[d][any] != items.size()) // else all have this digit
    {
      scatter(*from, d, *to);
      std::swap(from, to);
    }
  }
  if (from != &items)
  {
    // A copy, not a swap: two vectors that change places would grow one after the other.
    std::copy(other_.begin(), other_.end(), items.begin());
  }
  sortTies(items);
}

} // namespace pointfront
