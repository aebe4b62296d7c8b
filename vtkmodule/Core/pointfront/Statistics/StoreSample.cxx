#include "pointfront/Statistics/StoreSample.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace pointfront
{

namespace
{
constexpr std::size_t enoughPoints = 10000;
/// Most points of one node: its first points are a fair subset. Trees of others have large roots.
constexpr std::size_t mostOfNode = 20000;

template <typename T>
double valueAt(const std::byte* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double valueAt(ScalarType type, const std::byte* bytes)
{
  return visitScalar(type, [bytes](auto zero) { return valueAt<decltype(zero)>(bytes); });
}

/// Appends the values of the first points of a node.
void appendValues(const Attribute& attribute, const std::vector<std::byte>& bytes,
  std::size_t points, std::vector<std::vector<double>>& components)
{
  const std::size_t step = sizeOf(attribute.type);
  for (std::size_t i = 0; i < points; ++i)
  {
    const std::size_t at = i * attribute.bytes();
    for (std::size_t c = 0; c < attribute.components; ++c)
    {
      const double value = valueAt(attribute.type, bytes.data() + at + c * step);
      if (std::isfinite(value))
      {
        components[c].push_back(value);
      }
    }
  }
}

double quantile(const std::vector<double>& sorted, double share)
{
  if (sorted.empty())
  {
    return 0.0;
  }
  const double last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * last))];
}

std::vector<NodeIndex> childrenOf(const Hierarchy& hierarchy, const std::vector<NodeIndex>& level)
{
  std::vector<NodeIndex> next;
  for (const NodeIndex index : level)
  {
    hierarchy.appendChildren(index, hierarchy.node(index), next);
  }
  return next;
}
} // namespace

Result<StoreSample> StoreSample::read(const Hierarchy& hierarchy, const NodeReader& reader,
  const QuantisationGrid& grid, const AttributeSchema& schema, const ColumnSelection& selection)
{
  StoreSample sample;
  for (const std::uint32_t column : selection)
  {
    sample.columns_.emplace_back(schema[column].components);
  }
  std::vector<NodeIndex> level = hierarchy.roots();
  while (!level.empty() && sample.size() < enoughPoints)
  {
    for (const NodeIndex index : level)
    {
      const Result<NodeColumns> node = reader.read(index, selection);
      if (!node)
      {
        return node.error();
      }
      const std::size_t points = std::min(node->size(), mostOfNode);
      for (std::size_t i = 0; i < points; ++i)
      {
        const GridPosition step = node->origin + GridPosition(node->positions[i]);
        sample.elevations_.push_back(grid.toWorld(step).z);
      }
      for (std::size_t c = 0; c < selection.size(); ++c)
      {
        appendValues(schema[selection[c]], node->columns[c], points, sample.columns_[c]);
      }
    }
    level = childrenOf(hierarchy, level);
    if (std::optional<Error> damage = hierarchy.fault())
    {
      return *damage;
    }
  }
  std::sort(sample.elevations_.begin(), sample.elevations_.end());
  for (std::vector<std::vector<double>>& column : sample.columns_)
  {
    for (std::vector<double>& component : column)
    {
      std::sort(component.begin(), component.end());
    }
  }
  return sample;
}

double StoreSample::elevationQuantile(double share) const
{
  return quantile(elevations_, share);
}

double StoreSample::columnQuantile(std::size_t column, std::size_t component, double share) const
{
  return quantile(columns_[column][component], share);
}

} // namespace pointfront
