#include "pointfront/Statistics/PointGroups.h"

#include "pointfront/Points/QuantisationGrid.h"

#include <cmath>

namespace pointfront
{
namespace
{
std::optional<Rejection> rejectionOf(const glm::dvec3& p)
{
  if (std::abs(p.x) <= farthestCoordinate && std::abs(p.y) <= farthestCoordinate &&
    std::abs(p.z) <= farthestCoordinate)
  {
    return std::nullopt;
  }
  if (std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z))
  {
    return Rejection::NotANumber;
  }
  return std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z) ? Rejection::Infinite
                                                               : Rejection::OutsideGrid;
}
} // namespace

PointGroups::PointGroups(const AttributeSchema& schema)
  : column_(schema.find("classification"))
{
  if (column_ && schema[*column_].bytes() != 1)
  {
    column_.reset();
  }
}

void PointGroups::assign(
  const PointBatch& batch, std::vector<std::int16_t>& groups, RejectionCounts& rejected) const
{
  groups.resize(batch.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    if (const std::optional<Rejection> reason = rejectionOf(batch.positions[i]))
    {
      ++rejected[std::size_t(*reason)];
      groups[i] = none;
      continue;
    }
    groups[i] =
      column_ ? std::to_integer<std::int16_t>(batch.columns[*column_][i]) : std::int16_t(0);
  }
}

} // namespace pointfront
