#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A `.pfront` file, open for reading. The format: docs/formats/pfront.md.
/// Threads    all functions are safe from any thread (positional reads, no shared cursor).
/// Errors     open: NotFound, Unreadable, BadFormat (not a store), Unsupported (a newer version, or
///            made for other codecs), Truncated, Corrupt. fetch: Unreadable, Truncated. decode:
///            Corrupt with node and byte offset.
class PointStore final : public StoredCloud
{
public:
  /// So many of the last bytes of a far store are worth having at once: they have the tables of
  /// most stores and what a first picture shows.
  static constexpr std::size_t lastBytes = std::size_t(512) << 10;
  /// A preview (PreviewRecord.h) opens while its build runs, and stays readable after it; that of a
  /// killed build is Truncated.
  /// Errors  Unsupported, too, for a collection: its points are heads of tiles.
  static Result<std::shared_ptr<const PointStore>> open(const std::string& path);
  /// The heads in a collection's file, as the store that they are.
  /// Errors  BadFormat, too, for a store that is none.
  static Result<std::shared_ptr<const PointStore>> openHeads(const std::string& path);
  /// True if the file begins like a collection of any version. Cheap, silent.
  static bool looksLikeCollection(const std::string& path);
  /// True for the preview of a build, whether it still runs or was killed. Silent.
  static bool looksLikePreview(const std::string& path);
  /// True if the file begins like a store of any version. Cheap, silent.
  static bool looksLikeStore(const std::string& path);
  ~PointStore() override;

  const StoreDescription& description() const override;
  const std::shared_ptr<const Hierarchy>& hierarchy() const override;

  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  MissingRows* missingRows() const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::optional<std::uint64_t> place(NodeIndex node) const override;
  std::uint64_t disk() const override;
  ReadCost readCost() const override;

  Result<std::shared_ptr<const NodeRanges>> nodeRanges(
    std::uint32_t component, NodeIndex most = noNode) const override;
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  friend class PayloadCopy;
  PointStore();
  /// All but the file that payloads may lie in elsewhere.
  static Result<std::shared_ptr<PointStore>> openTables(const std::string& path);
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pointfront
