#pragma once

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Table/PointTable.h"
#include "pointfront/Table/TextRows.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// PTX (Leica Cyclone): scans one behind the other, each with its grid's size, its scanner's pose
/// and a matrix that takes its points into the common frame.
/// Rows      x y z intensity [red green blue]; x, y, z come out transformed. A row of 0 0 0 is a
///           direction that nothing came back from: NaN, rejected by the build.
/// Damage    scans that promise more rows than there are give what they have, with a warning.
class PTXTable final : public PointTable
{
public:
  /// True if the text begins like a scan: two counts, four rows of three and four of four numbers.
  static bool accepts(std::string_view text);
  /// Errors  BadFormat: the header of a scan is none, not one row is a point; Cancelled.
  static Result<std::unique_ptr<PointTable>> open(
    const std::string& path, MemoryMap map, const SurveyOptions& survey);

  const std::string& path() const override { return path_; }
  const std::string& format() const override { return format_; }
  const std::vector<TableField>& fields() const override { return fields_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }
  std::uint64_t chunkCount() const override { return chunks_.size(); }
  /// Each scan's origin, taken into the common frame as its points are.
  std::vector<ScannerPlace> scanners(const Bounds& positions) const override;
  std::uint64_t chunkRows(std::uint64_t chunk) const override;
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override;

private:
  struct Scan
  {
    std::array<double, 16> matrix{}; ///< rows as they are written: [x y z 1] times it
    std::uint64_t promised = 0;
    TextRows rows;
    bool coloured = false;
  };
  struct Chunk
  {
    std::size_t scan = 0;
    std::uint64_t chunk = 0;
  };

  PTXTable(std::string path, MemoryMap map)
    : path_(std::move(path))
    , map_(std::move(map))
  {
  }
  Result<void> index(const SurveyOptions& survey);

  std::string path_;
  std::string format_ = "PTX";
  MemoryMap map_;
  std::vector<TableField> fields_;
  std::vector<std::string> warnings_;
  std::vector<Scan> scans_;
  std::vector<Chunk> chunks_; ///< chunks of all scans
};

} // namespace pointfront
