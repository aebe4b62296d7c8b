#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

namespace pointfront
{

/// PLY 1.0: ascii, binary of both byte orders, any properties in any order. The points are the rows
/// of the element "vertex" (or "point"), wherever it stands; all other elements are passed over.
/// A file that was cut short is read up to its last whole row, with a warning.
class PLYFormat final : public PointSourceFormat
{
public:
  explicit PLYFormat(SurveyOptions survey = {})
    : survey_(std::move(survey))
  {
  }
  std::string name() const override { return "PLY"; }
  std::vector<std::string> extensions() const override { return { "ply" }; }
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;

private:
  SurveyOptions survey_;
};

} // namespace pointfront
