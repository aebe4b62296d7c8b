#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// Virtual point clouds (`.vpc`) and other STAC ItemCollections as one stored cloud: files of
/// points that this process opens in place (StoredCloudFormats). Where the list tells the box and
/// the number of points of each, files are opened when they are looked into (ListedCloud); else all
/// at once (TiledCloud). Errors  those of ItemCollection, ListedCloud and TiledCloud.
class STACFormat final : public StoredCloudFormat
{
public:
  static constexpr std::uint64_t mostListBytes = std::uint64_t(256)
    << 20; ///< 50,000 items with statistics

  std::string name() const override { return "virtual point cloud"; }
  /// By the name `.vpc`, or by the beginning of a JSON text.
  bool accepts(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
