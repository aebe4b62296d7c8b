#pragma once

#include "PLYFile.h"

#include "pointfront/Table/PointTable.h"

#include <memory>

namespace pointfront
{

/// The points of a binary PLY file, from its memory map, in chunks of 32,768 rows.
/// Lists     elements with lists that stand before the points are walked through row by row, once.
///           Points that have a list themselves have rows of different lengths: these are walked
///           through when the file is opened, which keeps where each chunk begins.
/// Damage    a file that ends early gives its whole rows, and a warning that counts the others.
class PLYBinaryTable final : public PointTable
{
public:
  /// Errors  Truncated if points are claimed and not one is there.
  static Result<std::unique_ptr<PointTable>> open(PLYFile file);

  const std::string& path() const override { return file_.path; }
  const std::string& format() const override { return file_.format; }
  const std::vector<TableField>& fields() const override { return fields_; }
  const std::vector<std::string>& warnings() const override { return file_.warnings; }
  std::uint64_t chunkCount() const override;
  std::uint64_t chunkRows(std::uint64_t chunk) const override;
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override;
  std::optional<std::uint64_t> headerPointCount() const override
  {
    return file_.pointElement().count;
  }

private:
  explicit PLYBinaryTable(PLYFile file);
  /// Finds the points and how many whole rows of them there are.
  Result<void> locate();
  void readFixed(std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const;
  void readListed(std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const;

  PLYFile file_;
  std::vector<TableField> fields_;
  bool swapped_ = false;
  std::uint64_t rows_ = 0;
  std::size_t begin_ = 0; ///< first byte of the points
  std::vector<std::size_t> chunkBegins_; ///< rows with lists only
};

} // namespace pointfront
