#pragma once

#include "pointfront/Points/AttributePass.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// Attribute "normal" (NormalAttribute.h) from the neighbours in the scan (EWA 3.2): no tree, no
/// second reading, no memory; coarser than PCA. For sources whose points are in the order of the
/// scan: files as the scanner's software writes them.
/// Lines    are found inside each chunk of a source: the first and the last line of a chunk have
///          one neighbouring line.
/// Sign     towards the scanner where a source tells where it stood, else up.
/// Zero     where no triangle is found, and for other classes than those asked for, which are
///          nobody's neighbours.
class ScanNormalsPass final : public AttributePass
{
public:
  /// `classes`: these only; nothing: all.
  explicit ScanNormalsPass(std::optional<std::vector<std::uint8_t>> classes);
  Result<PointSources> apply(PointSources sources, const PassResources& resources) const override;
  double reach() const override { return 0.0; }
  std::vector<std::string> findings() const override; ///< complete when the points are read

private:
  std::optional<std::vector<std::uint8_t>> classes_;
  std::shared_ptr<std::atomic<std::uint64_t>> without_;
};

} // namespace pointfront
