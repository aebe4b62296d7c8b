#pragma once

#include "pointfront/InPlace/NodeNormals.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>

namespace pointfront
{

/// A cloud without normals, with an attribute "normal" behind its own that is computed while a node
/// is decoded, for those who name it (StoreDescription::computed). The file stays as it is, and who
/// asks for other attributes pays nothing.
/// Node     a normal depends on the points of its node alone: at the border of a node on those on
///          one side of it, and in an inner node on points as far apart as that node's. A node has
///          the same normals each time it is read.
/// Memory   while a node is decoded, what NodeNormals takes beside the node.
/// Source   EWA (Kovac 2009), section 3: normals are calculated when the points of a leaf load.
/// Threads  all functions are safe from any thread.
class CloudWithNormals final : public StoredCloud
{
public:
  /// `cloud` itself if it has an attribute of that name.
  static std::shared_ptr<const StoredCloud> over(
    std::shared_ptr<const StoredCloud> cloud, std::shared_ptr<const NodeNormals> normals);

  const StoreDescription& description() const override { return description_; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return cloud_->hierarchy(); }
  std::vector<std::string> files() const override { return cloud_->files(); }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::uint64_t disk() const override { return cloud_->disk(); }
  ReadCost readCost() const override { return cloud_->readCost(); }
  MissingRows* missingRows() const override { return cloud_->missingRows(); }
  /// Null for the normals: nobody knows them before they are computed.
  Result<std::shared_ptr<const NodeRanges>> nodeRanges(
    std::uint32_t component, NodeIndex most = noNode) const override;
  /// Verifies the content of the files.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override
  {
    return cloud_->verify(progress);
  }

private:
  CloudWithNormals(
    std::shared_ptr<const StoredCloud> cloud, std::shared_ptr<const NodeNormals> normals);
  bool wanted(const ColumnSelection& columns) const;
  ColumnSelection own(const ColumnSelection& columns) const;
  Result<FetchedNode> wrapped(const WantedNode& want, Result<FetchedNode> inner) const;

  std::shared_ptr<const StoredCloud> cloud_;
  std::shared_ptr<const NodeNormals> normals_;
  StoreDescription description_;
  std::uint32_t column_ = 0; ///< number of the normals' column
};

/// Opens clouds as another format does, each with computed normals if it has none of its own.
class FormatWithNormals final : public StoredCloudFormat
{
public:
  FormatWithNormals(
    std::shared_ptr<const StoredCloudFormat> format, std::shared_ptr<const NodeNormals> normals)
    : format_(std::move(format))
    , normals_(std::move(normals))
  {
  }
  std::string name() const override { return format_->name(); }
  bool accepts(const std::string& path) const override { return format_->accepts(path); }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override
  {
    return withNormals(format_->open(path));
  }
  Result<std::shared_ptr<const StoredCloud>> openWhole(const std::string& path) const override
  {
    return withNormals(format_->openWhole(path));
  }

private:
  Result<std::shared_ptr<const StoredCloud>> withNormals(
    Result<std::shared_ptr<const StoredCloud>> cloud) const
  {
    return cloud ? CloudWithNormals::over(std::move(*cloud), normals_) : cloud;
  }

  std::shared_ptr<const StoredCloudFormat> format_;
  std::shared_ptr<const NodeNormals> normals_;
};

} // namespace pointfront
