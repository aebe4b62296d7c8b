#pragma once

#include "LASHeader.h"
#include "LASPointLayout.h"
#include "LASRecords.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Owner and id of the metadata record that keeps the header's global encoding field (2 bytes:
/// what GPS time means, above all) from a source to an export.
constexpr const char* lasKeptOwner = "PointFront";
constexpr std::uint16_t lasKeptEncodingRecord = 1;

/// A LAS or LAZ file with everything but its points understood.
/// description.pointCount is still the header's claim: the source that reads the points corrects
/// it.
struct LASFile
{
  MemoryMap map;
  LASHeader header;
  std::vector<LASRecord> records; ///< payloads point into `map`
  LASPointLayout layout;
  SourceDescription description;

  ByteSpan bytes() const { return { map.data(), map.size() }; }

  /// Errors   of MemoryMap::open and parseLASHeader; Unsupported if a point has a thousand
  ///          attributes.
  static Result<LASFile> open(
    const std::string& path, MemoryMap::Access access = MemoryMap::Access::Sequential);
  /// Reads the bytes of such a file. Errors  as open().
  static Result<LASFile> of(const std::string& path, MemoryMap map);

  /// Sets description.pointCount to the whole records that are there, with a warning if the header
  /// claims more. Uncompressed files only.
  /// Errors   Truncated if points are claimed and not one is there.
  Result<void> countRecords();
};

} // namespace pointfront
