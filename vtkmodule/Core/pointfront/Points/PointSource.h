#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointBatch.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A metadata record that travels unread from the source into the store (a LAS VLR: CRS, extra
/// bytes ...), so that an export gives it back.
struct MetadataRecord
{
  std::string owner; ///< LAS: user id, at most 16 characters
  std::uint16_t id = 0; ///< LAS: record id
  std::string description;
  std::vector<std::byte> payload;
};

/// The points of some chunks were seen from here.
struct ScannerPlace
{
  std::uint64_t firstChunk = 0; ///< that one and those behind it, up to the next place
  glm::dvec3 position{ 0.0 }; ///< world coordinates
};

/// What is known of a source before its points are read.
struct SourceDescription
{
  std::string path;
  std::string format; ///< for messages: "LAS 1.4 format 7", "LAZ 1.2 format 3" ...
  std::uint64_t pointCount = 0; ///< points that can be read (not what a lying header claims)
  Bounds declaredBounds; ///< from the header; a hint, may lie; empty if not given
  /// The grid that the coordinates already live on; nothing for sources of floating point.
  std::optional<QuantisationGrid> grid;
  AttributeSchema schema;
  std::string crsWkt; ///< CRS as WKT, if the source carries one as WKT
  /// Where the scanner stood, if the source says so (PCD VIEWPOINT, the scans of a PTX); by chunk.
  std::vector<ScannerPlace> scanners;
  std::vector<MetadataRecord> metadata; ///< CRS records kept as they are (LASF_Projection ...)
  /// Of the codes in the attribute `splat_radius` (SplatRadius.h); 0: not known, or there is none.
  double splatRadiusBase = 0.0;
  /// What was wrong and survived: each a full sentence that counts what was lost.
  std::vector<std::string> warnings;
  /// Points that the header claims; nothing: it claims none, they were counted.
  std::optional<std::uint64_t> headerPointCount;
  /// declaredBounds are not from a header, but of points that were looked at when the source was
  /// opened: all or some.
  bool boundsLookedUp = false;
  std::vector<std::string> furtherFiles; ///< that it reads besides `path`
  /// Points come in the order of a tree, not as they were scanned.
  bool inTreeOrder = false;
  /// 16-bit colours have 16 bits, however small the largest is: who stored them has decided that.
  bool deepColours = false;

  /// From where a chunk was seen; none if that is not known.
  const glm::dvec3* scanner(std::uint64_t chunk) const
  {
    const glm::dvec3* position = nullptr;
    for (const ScannerPlace& place : scanners)
    {
      position = place.firstChunk <= chunk ? &place.position : position;
    }
    return position;
  }
};

/// A readable cloud, cut into chunks that can be read in any order by any thread.
/// Threads   description(), chunkCount() and chunkPoints() are constant; read() is thread-safe.
/// Errors    read() gives Truncated or BadFormat with path and byte offset.
/// Order     the input index of a point is its rank in (chunk, position in chunk); results that
///           depend on order use it, so they do not depend on which thread came first.
class PointSource
{
public:
  virtual ~PointSource() = default;
  virtual const SourceDescription& description() const = 0;
  virtual std::uint64_t chunkCount() const = 0;
  virtual std::uint64_t chunkPoints(std::uint64_t chunk) const = 0; ///< some ten thousand
  /// Fills `batch` with that chunk's points: chunkPoints(chunk) of them, columns as in the schema.
  virtual Result<void> read(std::uint64_t chunk, PointBatch& batch) const = 0;
  /// The same for a reader that works on description().grid itself: a source that has whole steps
  /// may give batch.steps instead of batch.positions. grid->toGrid() of a position that read()
  /// gives is that step.
  virtual Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const
  {
    return read(chunk, batch);
  }
};

/// The files that some sources read.
inline std::vector<std::string> pathsOf(const std::vector<std::unique_ptr<PointSource>>& sources)
{
  std::vector<std::string> paths;
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    paths.push_back(description.path);
    paths.insert(paths.end(), description.furtherFiles.begin(), description.furtherFiles.end());
  }
  return paths;
}

/// Opens files of one family. Registered by the program at the top (IO modules do not know each
/// other), asked in turn.
class PointSourceFormat
{
public:
  virtual ~PointSourceFormat() = default;
  virtual std::string name() const = 0; ///< "LAS/LAZ"
  virtual std::vector<std::string> extensions() const = 0; ///< lower case, without the dot
  virtual bool accepts(const std::string& path) const = 0; ///< by content, silent
  virtual Result<std::unique_ptr<PointSource>> open(const std::string& path) const = 0;
};

} // namespace pointfront
