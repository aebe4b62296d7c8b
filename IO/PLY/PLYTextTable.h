#pragma once

#include "PLYFile.h"

#include "pointfront/Table/ParallelChunks.h"
#include "pointfront/Table/TextRowsTable.h"

#include <memory>
#include <optional>

namespace pointfront
{

/// The points of an ascii PLY file: one row a line, as every writer does it.
/// Damage    a file that ends early gives the rows that are there, and a warning.
class PLYTextTable final : public TextRowsTable
{
public:
  /// Errors  Truncated if points are claimed and not one is there; Cancelled.
  static Result<std::unique_ptr<PointTable>> open(PLYFile file, const SurveyOptions& survey);

  const std::string& path() const override { return file_.path; }
  const std::string& format() const override { return file_.format; }
  const std::vector<TableField>& fields() const override { return fields_; }
  const std::vector<std::string>& warnings() const override { return file_.warnings; }
  std::optional<std::uint64_t> headerPointCount() const override
  {
    return file_.pointElement().count;
  }

private:
  explicit PLYTextTable(PLYFile file)
    : file_(std::move(file))
    , fields_(file_.fields())
  {
  }
  Result<void> index(const SurveyOptions& survey);

  PLYFile file_;
  std::vector<TableField> fields_;
};

} // namespace pointfront
