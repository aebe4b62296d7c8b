#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>

namespace pointfront
{

/// A file of points of any family that this program reads, shown at a glance. The window alone
/// opens it so, because it shows the rest soon; to commands that draw one picture such a file is no
/// store.
class GlancedFileFormat final : public StoredCloudFormat
{
public:
  /// A file of points from which a store can be built, and none that has a tree itself.
  static bool isPointFile(const std::string& path);
  /// A folder of LAS and LAZ files, and of no store.
  static bool isFolderOfPoints(const std::string& path);

  std::string name() const override { return "point file at a glance"; }
  bool accepts(const std::string& path) const override { return isPointFile(path); }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
