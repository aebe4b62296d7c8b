#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// The user's choices for text files; zero: found by looking at their beginning.
struct TextChoice
{
  char separator = '\0'; ///< as in TextLayout
  char decimalPoint = '\0'; ///< '.' or ','
  std::uint64_t skip = 0; ///< lines at the beginning that are neither header nor rows
};

/// Points as text: XYZ, TXT, CSV, PTS, ASC, one a line; and PTX. What the columns are is said by a
/// header, by the user or by what they hold: see TextColumns.
class TextFormat final : public PointSourceFormat
{
public:
  /// `columns`: names for the columns of every text file, "-" for those that are left out; empty:
  /// by header or guess.
  /// `temporaryFolder` is where gzip and UTF-16 are unpacked; empty: the system's.
  explicit TextFormat(std::vector<std::string> columns = {}, SurveyOptions survey = {},
    TextChoice choice = {}, std::string temporaryFolder = {})
    : columns_(std::move(columns))
    , survey_(std::move(survey))
    , choice_(choice)
    , temporaryFolder_(std::move(temporaryFolder))
  {
  }
  std::string name() const override { return "XYZ/TXT/CSV/PTS/PTX"; }
  std::vector<std::string> extensions() const override
  {
    return { "xyz", "txt", "csv", "pts", "asc", "ptx", "tsv", "gz" };
  }
  /// True for text with a row of numbers near its beginning, whatever it is called.
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;

private:
  std::vector<std::string> columns_;
  SurveyOptions survey_;
  TextChoice choice_;
  std::string temporaryFolder_;
};

} // namespace pointfront
