#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A first look at many LAS and LAZ files: of each the first point of every chunk, which LAZ keeps
/// as it is, and of LAS files one of each 50,000; of all files together `mostPoints` at most.
/// Nothing is decompressed.
/// Errors  those of the files: of several the first, with their number; NotFound: no file.
Result<std::shared_ptr<const StoredCloud>> glanceAtLAS(const std::string& path,
  const std::vector<std::string>& files, std::size_t mostPoints = std::size_t(1) << 20);

/// A folder that holds LAS or LAZ files (below it, too) and no store, shown at a glance.
class LAZGlanceFormat final : public StoredCloudFormat
{
public:
  std::string name() const override { return "folder of LAS and LAZ files"; }
  bool accepts(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
