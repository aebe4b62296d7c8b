#pragma once

#include "TextColumns.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Table/TextRowsTable.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The user's wishes for a text file.
struct TextWishes
{
  const std::vector<std::string>& columns;
  const TextChoice& choice;
};

/// The rows of a text file of points.
class TextTable final : public TextRowsTable
{
public:
  /// Errors  of TextColumns::find; BadFormat: more lines are no points than are; Cancelled.
  static Result<std::unique_ptr<PointTable>> open(
    const std::string& path, MemoryMap map, const TextWishes& wishes, const SurveyOptions& survey);

  const std::string& path() const override { return path_; }
  const std::string& format() const override { return format_; }
  const std::vector<TableField>& fields() const override { return fields_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

private:
  TextTable(std::string path, MemoryMap map)
    : path_(std::move(path))
    , map_(std::move(map))
  {
  }
  Result<void> index(const TextColumns& columns, const SurveyOptions& survey);
  void warn(const TextColumns& columns);

  std::string path_;
  std::string format_ = "text";
  MemoryMap map_;
  std::vector<TableField> fields_;
  std::vector<std::string> warnings_;
};

/// The beginning of a text file that is looked at before it is read: whole lines.
std::string_view beginningOf(const MemoryMap& map);

} // namespace pointfront
