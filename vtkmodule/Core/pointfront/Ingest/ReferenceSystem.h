#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The coordinate reference system that all sources share, and the records that travel with it.
struct ReferenceSystem
{
  std::string wkt;
  /// Records of the first source that names a system, and what GPS times all sources have together.
  std::vector<MetadataRecord> metadata;
  std::vector<std::string> warnings;
};

/// Error BadArgument, naming both files, when two sources say different systems: points of two
/// systems never go into one store as they are. A source that says none is taken as it is, with
/// a warning; GPS times of two kinds are, too.
Result<ReferenceSystem> commonReferenceSystem(
  const std::vector<std::unique_ptr<PointSource>>& sources);

} // namespace pointfront
