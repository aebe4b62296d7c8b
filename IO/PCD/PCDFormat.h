#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <string>
#include <utility>

namespace pointfront
{

/// PCD .5 to .7: ascii, binary, binary_compressed; any fields. Points are left in the frame they
/// are stored in: VIEWPOINT says where the sensor was, and moves nothing.
class PCDFormat final : public PointSourceFormat
{
public:
  /// `temporaryFolder` is where large compressed blocks are unpacked; empty: the system's.
  explicit PCDFormat(SurveyOptions survey = {}, std::string temporaryFolder = {})
    : survey_(std::move(survey))
    , temporaryFolder_(std::move(temporaryFolder))
  {
  }
  std::string name() const override { return "PCD"; }
  std::vector<std::string> extensions() const override { return { "pcd" }; }
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;

private:
  SurveyOptions survey_;
  std::string temporaryFolder_;
};

} // namespace pointfront
