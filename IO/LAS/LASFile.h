#pragma once

#include "LASHeader.h"
#include "LASPointLayout.h"
#include "LASRecords.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Disk/SparseBytes.h"
#include "pointfront/Points/PointSource.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A LAS or LAZ file with everything but its points understood.
/// description.pointCount is still the header's claim: the source that reads the points corrects
/// it.
struct LASFile
{
  MemoryMap map; ///< lies over `far` if the file is far
  LASHeader header;
  std::vector<LASRecord> records; ///< payloads point into `map`
  LASPointLayout layout;
  SourceDescription description;
  /// Null: a file on a disk. Else header and records are there, and of the rest what want() reads.
  std::shared_ptr<SparseBytes> far = nullptr;

  /// Before bytes() are looked at beyond header and records: reads these parts together if the file
  /// is a far one.
  Result<void> want(const std::vector<HeldBytes::Part>& parts) const
  {
    return far ? far->want(parts) : Result<void>();
  }
  ByteSpan bytes() const { return { map.data(), map.size() }; }

  /// A path, or an address: of a far file only header and records are read.
  /// Errors   of MemoryMap::open or openBytes, and parseLASHeader; Unsupported if a point has a
  /// thousand
  ///          attributes.
  static Result<LASFile> open(
    const std::string& path, MemoryMap::Access access = MemoryMap::Access::Sequential);
  /// Reads the bytes of such a file. Errors  as open().
  static Result<LASFile> of(const std::string& path, MemoryMap map);
  /// The same for a source that is open already. Errors  as open().
  static Result<LASFile> of(std::shared_ptr<const ByteSource> source);

  /// Sets description.pointCount to the whole records that are there, with a warning if the header
  /// claims more. Uncompressed files only.
  /// Errors   Truncated if points are claimed and not one is there.
  Result<void> countRecords();
};

} // namespace pointfront
