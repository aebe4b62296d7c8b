#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The coordinate reference system that all sources share, and the records that travel with it.
struct ReferenceSystem
{
  std::string wkt;
  /// Records of the first source that names a system.
  std::vector<MetadataRecord> metadata;
  std::vector<std::string> warnings;

  /// Adds a record of what GPS times the sources have together that give points, and a warning
  /// where they have two kinds. A source that gives none, by its number, has no say.
  void keepTimes(const std::vector<std::unique_ptr<PointSource>>& sources,
    const std::function<bool(std::size_t)>& givesPoints);
};

/// Error BadArgument, naming both files, when two sources say different systems: points of two
/// systems never go into one store as they are. A source that says none is taken as it is, with
/// a warning.
Result<ReferenceSystem> commonReferenceSystem(
  const std::vector<std::unique_ptr<PointSource>>& sources);

} // namespace pointfront
