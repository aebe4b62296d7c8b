#pragma once

#include "EPTFolder.h"

#include "pointfront/Table/PointTable.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The content of a node's file: its records, unpacked if need be.
/// Errors  Truncated, BadFormat with `path`: not as many bytes as `expected`, damaged zstd.
Result<std::vector<std::byte>> eptRecords(
  std::string_view file, EPTEncoding encoding, std::size_t expected, const std::string& path);

/// The records of an Entwine tree whose nodes are binary or zstandard: each node is a chunk.
class EPTRecords final : public PointTable
{
public:
  /// Errors  NotFound: the file of a node; Truncated: a binary one of another size than its points
  ///         have.
  static Result<std::unique_ptr<EPTRecords>> open(std::shared_ptr<const EPTFolder> tree);

  const std::string& path() const override { return tree_->path; }
  const std::string& format() const override { return format_; }
  const std::vector<TableField>& fields() const override { return fields_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }
  std::uint64_t chunkCount() const override { return tree_->nodes.size(); }
  std::uint64_t chunkRows(std::uint64_t chunk) const override
  {
    return tree_->nodes[static_cast<std::size_t>(chunk)].points;
  }
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override;
  /// The same, of the bytes of the node's file.
  Result<void> decode(const EPTNode& node, const RawBytes& file, const std::vector<bool>& wanted,
    TableBlock& block) const;
  std::optional<QuantisationGrid> grid() const override { return tree_->description.grid(); }

private:
  EPTRecords() = default;
  Result<void> checkFiles() const;

  std::shared_ptr<const EPTFolder> tree_;
  std::string format_;
  std::vector<TableField> fields_;
  std::vector<std::string> warnings_;
};

} // namespace pointfront
