#pragma once

#include "PCDFile.h"

#include "pointfront/Table/ParallelChunks.h"
#include "pointfront/Table/TextRowsTable.h"

#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// The points of an ascii PCD file: one a line, its numbers separated by blanks, tabs or commas.
class PCDTextTable final : public TextRowsTable
{
public:
  /// Errors  Truncated, as PCDFile::countPresent; Cancelled.
  static Result<std::unique_ptr<PointTable>> open(PCDFile file, const SurveyOptions& survey);

  const std::string& path() const override { return file_.path; }
  const std::string& format() const override { return file_.format; }
  const std::vector<TableField>& fields() const override { return file_.fields; }
  const std::vector<std::string>& warnings() const override { return file_.warnings; }
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override;
  std::optional<std::uint64_t> headerPointCount() const override { return file_.header.points; }
  std::vector<FieldStatistics> statistics() const override;
  glm::dvec3 origin() const override { return file_.header.origin.value_or(glm::dvec3(0.0)); }
  std::vector<ScannerPlace> scanners(const Bounds& positions) const override
  {
    return file_.scanners(positions);
  }

private:
  explicit PCDTextTable(PCDFile file)
    : file_(std::move(file))
  {
  }
  Result<void> index(const SurveyOptions& survey);
  TextLayout layOut();

  PCDFile file_;
  std::vector<std::size_t> columns_; ///< for each field the number of a row that it is taken from
};

} // namespace pointfront
