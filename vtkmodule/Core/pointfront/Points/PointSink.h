#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointBatch.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts that a sink must know before its first point. A StoreDescription and a
/// SourceDescription both hold these facts, so either can be passed on member by member.
struct SinkDescription
{
  AttributeSchema schema; ///< schema of every batch that follows
  /// The grid that the coordinates live on. A file of integers (LAS) is written on this grid, so
  /// that integers stay the same; a text file prints as many digits as this grid needs.
  QuantisationGrid grid;
  /// On axes whose coordinates lie on no grid, because they were transformed: the step that they
  /// had before, in their own units. A file of integers may round by as much; 0: by nothing.
  glm::dvec3 stepBefore{ 0.0 };
  /// Box of all points that will come, for sinks that must place an integer range; may be empty.
  Bounds bounds;
  std::uint64_t pointCount = 0; ///< how many will come, 0 if not known
  /// Largest value of any component of each column, as stored; empty if not known. Lets LAS choose
  /// a point format that holds them (classes above 31, more than 7 returns).
  std::vector<double> largest;
  std::vector<double> smallest; ///< the same of the smallest values
  std::string crsWkt;
  std::vector<MetadataRecord> metadata; ///< as the source gave it (LAS: VLRs of the CRS ...)
};

/// A file being written from points: begin(), append() as often as there are batches, finish(). The
/// file is whole or absent: the sink writes to a temporary name beside `path` and renames it in
/// finish(). A sink that is destroyed before finish() succeeded removes its temporary file; a file
/// that was at `path` before stays.
/// Order    points are written in the order they come.
/// Threads  one thread.
/// Errors   Unwritable (permission, full disk), BadArgument (what the format cannot hold: a
///          coordinate out of its range, an attribute too wide). After an Error the sink is dead.
class PointSink
{
public:
  virtual ~PointSink() = default;
  /// Path of the file that finish() writes; empty for a sink that writes no file.
  virtual std::string path() const { return {}; }
  virtual Result<void> begin(const SinkDescription& description) = 0;
  virtual Result<void> append(const PointBatch& batch) = 0;
  virtual Result<void> finish() = 0;
  /// Facts that readers of the file should know, and attributes that it could not keep: full
  /// sentences, after finish().
  virtual std::vector<std::string> findings() const { return {}; }
};

} // namespace pointfront
