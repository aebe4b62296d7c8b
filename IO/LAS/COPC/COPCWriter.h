#pragma once

#include "LASExport.h"

#include "pointfront/Base/Progress.h"
#include "pointfront/Points/PointSink.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Writes points as COPC 1.0: LAZ 1.4 of point format 6, 7 or 8 whose chunks are the nodes of an
/// octree. Every point is in one node, and inside the node's cell.
/// Nodes       COPCLevels.
/// Attributes  as LASWriter, but that wave packets become extra bytes, and that a reference system
///             must be WKT: GeoTIFF keys are left out, with a finding where there is no WKT.
/// Rounding    scan angles of point formats 0 to 5 are whole degrees, those here steps of 0.006
///             degrees.
/// Memory      Options::memoryBytes, of which the query that brings the points has its part
///             (COPCMemory); and the compressed bytes of nodes larger than 2 MiB, while they come.
/// Disk        more points than that lie in temporary files meanwhile: as many bytes as a LAS file.
/// Order       the same points give the same bytes if they come in the same order, whatever the
///             memory.
/// Source      COPC 1.0, copc.io; how points find their nodes: docs/adr/0047.
/// Errors      as in PointSink; Cancelled; BadArgument where memoryBytes is too little, with the
///             least amount that works.
/// Threads     one thread calls; nodes are compressed on others.
class COPCWriter final : public PointSink
{
public:
  struct Options
  {
    static constexpr std::uint64_t usualMemoryBytes = std::uint64_t{ 512 } << 20;
    std::uint64_t memoryBytes = usualMemoryBytes; ///< for points, read, sorted and written
    std::uint64_t readBytes = 0; ///< the part that the query needs that brings the points
    std::string temporaryFolder; ///< empty: the file's own
    LASDate created = LASDate::today();
    /// Messages call so the choice of a build that names a system for inputs without one.
    std::string assumedCrsName = "AssumedCRS";
    /// Told of finish(), which is half of the work; false cancels.
    ProgressFunction progress = {};
  };

  COPCWriter(std::string path, Options options);
  ~COPCWriter() override;
  COPCWriter(const COPCWriter&) = delete;
  COPCWriter& operator=(const COPCWriter&) = delete;

  std::string path() const override;
  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  Result<void> finish() override;
  std::vector<std::string> findings() const override;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
