#pragma once

#include "PLYHeader.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Table/PointTable.h"

#include <string>
#include <vector>

namespace pointfront
{

/// A PLY file with its header understood: what its tables share.
struct PLYFile
{
  MemoryMap map;
  std::string path;
  PLYHeader header;
  std::size_t points = 0; ///< the element that holds them
  std::string format; ///< "PLY ascii" ...
  std::vector<std::string> warnings;

  const PLYElement& pointElement() const { return header.elements[points]; }
  /// The scalar properties of the points, without its lists.
  std::vector<TableField> fields() const;

  /// Errors  of MemoryMap::open and PLYHeader::parse; Unsupported if no element holds points.
  static Result<PLYFile> open(const std::string& path);
};

} // namespace pointfront
