#include "pointfront/Tiles/TileRanges.h"

#include "pointfront/Store/NodeRangesSection.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t mostMarks = 256;

void thin(std::vector<double>& marks)
{
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  if (marks.size() > mostMarks)
  {
    std::vector<double> kept;
    for (std::size_t mark = 0; mark < mostMarks; ++mark)
    {
      kept.push_back(marks[mark * (marks.size() - 1) / (mostMarks - 1)]);
    }
    marks = std::move(kept);
  }
}
} // namespace

WholeComponent WholeComponent::of(std::uint32_t number, const AttributeSchema& schema)
{
  if (number < coordinateComponents)
  {
    return { 0, number, nullptr };
  }
  std::uint32_t left = number - coordinateComponents;
  std::uint32_t column = 0;
  for (; left >= schema[column].components; ++column)
  {
    left -= static_cast<std::uint32_t>(schema[column].components);
  }
  return { column, left, &schema[column] };
}

void TileRanges::addUnknown()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  add({ -infinity, infinity }, { -infinity, infinity });
}

std::shared_ptr<const NodeRanges> TileRanges::together() const
{
  std::vector<double> marks;
  for (const std::vector<ValueRange>* ranges : { &own_, &below_ })
  {
    for (const ValueRange& range : *ranges)
    {
      if (!range.empty())
      {
        marks.push_back(range.low);
        marks.push_back(range.high);
      }
    }
  }
  thin(marks);
  std::vector<NodeRanges::Codes> codes(marks.empty() ? 0 : own_.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    putRangeCodes(own_[i], marks, &codes[i][0]);
    putRangeCodes(below_[i], marks, &codes[i][2]);
  }
  return std::make_shared<const NodeRanges>(
    static_cast<NodeIndex>(own_.size()), std::move(marks), std::move(codes));
}

} // namespace pointfront
