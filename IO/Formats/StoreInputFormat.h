#pragma once

#include "pointfront/Points/PointSource.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Stores, and indices of LAS files, as inputs of a build. An index stands for the file that it is
/// of: the points are read from there, in its order.
class StoreInputFormat final : public PointSourceFormat
{
public:
  std::string name() const override { return "PointFront store"; }
  std::vector<std::string> extensions() const override { return { "pfront", "pfindex" }; }
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;
};

} // namespace pointfront
