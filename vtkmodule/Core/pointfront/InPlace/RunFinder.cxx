#include "pointfront/InPlace/RunFinder.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::uint64_t longestStep = 256;

struct Rectangle
{
  glm::ivec2 low;
  glm::ivec2 high;

  bool holds(const RecordBox& box) const
  {
    return box.low.x >= low.x && box.high.x <= high.x && box.low.y >= low.y && box.high.y <= high.y;
  }
};
} // namespace

LeafRun RunFinder::runFrom(std::uint64_t first, std::uint64_t end) const
{
  LeafRun run;
  run.first = first;
  const glm::ivec3 start = records_.position(first);
  run.leaf = grid_.at(start);
  run.box.add(start);
  const Square& square = tree_.nodes()[run.leaf].square;
  const Rectangle inside{ grid_.low(square), grid_.high(square) };
  std::uint64_t at = first + 1;
  std::uint64_t step = 1;
  while (at < end)
  {
    std::uint64_t ahead = std::min(step, end - at);
    const RecordBox box = boxOf(records_, at, at + ahead);
    if (inside.holds(box))
    {
      run.box.add(box);
      at += ahead;
      step = std::min(2 * step, longestStep);
      continue;
    }
    while (ahead > 1) // among the next `ahead` points is the first outside
    {
      const std::uint64_t half = ahead / 2;
      const RecordBox lower = boxOf(records_, at, at + half);
      if (inside.holds(lower))
      {
        run.box.add(lower);
        at += half;
        ahead -= half;
      }
      else
      {
        ahead = half;
      }
    }
    break;
  }
  run.count = at - first;
  return run;
}

void RunFinder::find(std::uint64_t begin, std::uint64_t end, std::vector<LeafRun>& runs) const
{
  while (begin < end)
  {
    runs.push_back(runFrom(begin, end));
    begin += runs.back().count;
  }
}

} // namespace pointfront
