#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// Points as text: XYZ, TXT, CSV, PTS, ASC, one a line; and PTX. What the columns are is said by a
/// header, by the user or by what they hold: see TextColumns.
class TextFormat final : public PointSourceFormat
{
public:
  /// `columns`: names for the columns of every text file, "-" for those that are left out; empty:
  /// by header or guess.
  explicit TextFormat(std::vector<std::string> columns = {}, SurveyOptions survey = {})
    : columns_(std::move(columns))
    , survey_(std::move(survey))
  {
  }
  std::string name() const override { return "XYZ/TXT/CSV/PTS/PTX"; }
  std::vector<std::string> extensions() const override
  {
    return { "xyz", "txt", "csv", "pts", "asc", "ptx" };
  }
  /// True for text with a row of numbers near its beginning, whatever it is called.
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;

private:
  std::vector<std::string> columns_;
  SurveyOptions survey_;
};

} // namespace pointfront
