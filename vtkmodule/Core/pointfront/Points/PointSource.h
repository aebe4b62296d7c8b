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

/// The place from which the scanner saw the points of some chunks.
struct ScannerPlace
{
  std::uint64_t firstChunk = 0; ///< that one and those behind it, up to the next place
  glm::dvec3 position{ 0.0 }; ///< world coordinates
};

/// The facts about a source that are known before its points are read.
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
  /// Places of the scanner, if the source has them (PCD VIEWPOINT, the scans of a PTX); by chunk.
  std::vector<ScannerPlace> scanners;
  std::vector<MetadataRecord> metadata; ///< CRS records kept as they are (LASF_Projection ...)
  /// Base of the codes in the attribute `splat_radius` (SplatRadius.h); 0: not known, or no such
  /// attribute.
  double splatRadiusBase = 0.0;
  /// Faults that the source survived: each is a full sentence that counts what was lost.
  std::vector<std::string> warnings;
  /// Number of points that the header claims; nothing: the header has no number, the points were
  /// counted.
  std::optional<std::uint64_t> headerPointCount;
  /// declaredBounds do not come from a header, but from all or some points that were read when the
  /// source was opened.
  bool boundsLookedUp = false;
  std::vector<std::string> furtherFiles; ///< that it reads besides `path`
  /// Points come in the order of a tree, not as they were scanned.
  bool inTreeOrder = false;
  /// 16-bit colours have 16 bits, however small the largest value of these points is: the writer of
  /// the store decided so, or others of the cloud need them.
  bool deepColours = false;
  /// Largest value of its 16-bit colours ("rgb"), if whoever opened the source knows it.
  std::optional<std::uint16_t> largestColour;
  /// The image that its colours have 16 bits from, if its own points have none that need them.
  std::string colourImage;

  /// The scanner's place for a chunk; none if it is not known.
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
/// Order     the input index of a point is its number in (chunk, position in chunk); results that
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
  /// The same for a caller that works on description().grid: a source that has whole steps may give
  /// batch.steps instead of batch.positions. The steps equal grid->toGrid() of the positions that
  /// read() gives.
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

/// Opens files of one family. The program registers the formats (IO modules do not know each
/// other), and each format is asked in turn.
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
