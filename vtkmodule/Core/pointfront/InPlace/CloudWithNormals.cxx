#include "pointfront/InPlace/CloudWithNormals.h"

#include "pointfront/Store/ColumnStatistics.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace pointfront
{

std::shared_ptr<const StoredCloud> CloudWithNormals::over(
  std::shared_ptr<const StoredCloud> cloud, std::shared_ptr<const NodeNormals> normals)
{
  if (cloud->description().schema.find(normalAttribute().name))
  {
    return cloud;
  }
  return std::shared_ptr<const StoredCloud>(
    new CloudWithNormals(std::move(cloud), std::move(normals)));
}

CloudWithNormals::CloudWithNormals(
  std::shared_ptr<const StoredCloud> cloud, std::shared_ptr<const NodeNormals> normals)
  : cloud_(std::move(cloud))
  , normals_(std::move(normals))
  , description_(cloud_->description())
  , column_(static_cast<std::uint32_t>(description_.schema.size()))
{
  Attribute attribute = normalAttribute();
  attribute.description = "unit normal; zero where there is none; " + normals_->origin();
  description_.schema.add(std::move(attribute));
  const double most = normalSteps;
  description_.ranges.push_back({ { { -most, most }, { -most, most }, { -most, most } } });
  description_.computed.push_back(column_);
}

bool CloudWithNormals::wanted(const ColumnSelection& columns) const
{
  return !columns.empty() && columns.back() == column_; // ascending, and it is the last
}

/// Those that the cloud has.
ColumnSelection CloudWithNormals::own(const ColumnSelection& columns) const
{
  return ColumnSelection(columns.begin(), columns.end() - (wanted(columns) ? 1 : 0));
}

Result<FetchedNode> CloudWithNormals::wrapped(
  const WantedNode& want, Result<FetchedNode> inner) const
{
  if (!inner || !wanted(want.columns))
  {
    return inner;
  }
  FetchedNode fetched{ want.node, want.columns, {}, inner->bytesRead, inner->row };
  fetched.inner = std::make_shared<const FetchedNode>(std::move(*inner));
  return fetched;
}

Result<FetchedNode> CloudWithNormals::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  return wrapped({ node, columns }, cloud_->fetch(node, own(columns)));
}

std::vector<Result<FetchedNode>> CloudWithNormals::fetchAll(
  const std::vector<WantedNode>& wants, const ReadStop& stop) const
{
  std::vector<WantedNode> inner;
  for (const WantedNode& want : wants)
  {
    inner.push_back({ want.node, own(want.columns) });
  }
  std::vector<Result<FetchedNode>> fetched = cloud_->fetchAll(inner, stop);
  for (std::size_t i = 0; i < wants.size(); ++i)
  {
    fetched[i] = wrapped(wants[i], std::move(fetched[i]));
  }
  return fetched;
}

Result<NodeColumns> CloudWithNormals::decode(const FetchedNode& fetched) const
{
  if (!wanted(fetched.columns))
  {
    return cloud_->decode(fetched);
  }
  Result<NodeColumns> node = cloud_->decode(*fetched.inner);
  if (!node)
  {
    return node;
  }
  std::vector<glm::dvec3> positions(node->size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    positions[i] = description_.grid.toWorld(node->origin + GridPosition(node->positions[i]));
  }
  std::vector<PackedNormal> normals;
  normals_->compute(positions, normals);
  assert(normals.size() == positions.size());
  std::vector<std::byte> values(normals.size() * sizeof(PackedNormal));
  std::copy_n(reinterpret_cast<const std::byte*>(normals.data()), values.size(), values.data());
  node->selection = fetched.columns;
  node->columns.push_back(std::move(values));
  return node;
}

std::size_t CloudWithNormals::decodedBytes(
  NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const
{
  return wanted(columns) ? decodedBytesOf(points, columns, description_.schema)
                         : cloud_->decodedBytes(node, points, columns);
}

std::size_t CloudWithNormals::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  return cloud_->storedBytes(node, own(columns));
}

Result<std::shared_ptr<const NodeRanges>> CloudWithNormals::nodeRanges(
  std::uint32_t component, NodeIndex most) const
{
  return component < rangeComponents(cloud_->description().schema)
    ? cloud_->nodeRanges(component, most)
    : std::shared_ptr<const NodeRanges>();
}

} // namespace pointfront
