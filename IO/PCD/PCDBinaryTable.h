#pragma once

#include "PCDFile.h"

#include "pointfront/Disk/SpillFile.h"
#include "pointfront/Table/PointTable.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The points of a binary PCD file, in chunks of 32,768.
/// binary             records, read from the memory map.
/// binary_compressed  one LZF block of columns, which can only be unpacked from its beginning on.
///                    It is unpacked when the file is opened: into memory up to 64 MiB, beyond
///                    that into a file in the temporary folder that has no name.
/// Damage             a cut `binary` gives its whole points (PCDFile::countPresent); a cut block is
///                    refused: its last columns are missing for every point.
class PCDBinaryTable final : public PointTable
{
public:
  /// Errors  Truncated, Corrupt; Unwritable from the temporary folder.
  static Result<std::unique_ptr<PointTable>> open(PCDFile file, const std::string& temporaryFolder);

  const std::string& path() const override { return file_.path; }
  const std::string& format() const override { return file_.format; }
  const std::vector<TableField>& fields() const override { return file_.fields; }
  const std::vector<std::string>& warnings() const override { return file_.warnings; }
  std::uint64_t chunkCount() const override;
  std::uint64_t chunkRows(std::uint64_t chunk) const override;
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override;
  std::optional<std::uint64_t> headerPointCount() const override { return file_.header.points; }
  glm::dvec3 origin() const override { return file_.header.origin.value_or(glm::dvec3(0.0)); }
  std::vector<ScannerPlace> scanners(const Bounds& positions) const override
  {
    return file_.scanners(positions);
  }

private:
  explicit PCDBinaryTable(PCDFile file)
    : file_(std::move(file))
  {
  }
  Result<void> locateRecords();
  Result<void> unpack(const std::string& temporaryFolder);
  Result<void> locateFields(std::uint64_t packed, std::uint64_t unpacked);
  Result<void> decode(
    const std::byte* block, std::size_t blockBytes, std::uint64_t bytes, bool spilled);
  void readRecords(std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const;
  Result<void> readColumns(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const;

  PCDFile file_;
  std::uint64_t points_ = 0;
  /// Where each field of the header begins: in a record, or as a column of the unpacked block.
  std::vector<std::uint64_t> fieldBegins_;
  std::vector<std::byte> columns_; ///< unpacked, if small
  std::unique_ptr<SpillFile> spilled_; ///< unpacked, if large
};

} // namespace pointfront
