#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>

namespace pointfront
{

/// The points of the input that a stored cloud holds, a chunk for each node: each once, on the
/// cloud's own grid, without representatives and without the radius of these. With a box only the
/// nodes that reach into it, and all of their points.
/// Metadata  the cloud's, as its own source gave it.
/// Order     of the tree: what needs the order of a scan refuses it.
class StoredPoints final : public PointSource
{
public:
  /// Errors  of the node table; BadArgument for the preview of a build, which has a part of the
  ///         points.
  static Result<std::unique_ptr<PointSource>> open(
    std::shared_ptr<const StoredCloud> cloud, const Bounds* box = nullptr);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return plan_.nodeCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return plan_.nodePoints(static_cast<std::size_t>(chunk));
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override;

private:
  StoredPoints(std::shared_ptr<const StoredCloud> cloud, QueryPlan plan, bool whole);
  Result<NodeColumns> node(std::uint64_t chunk) const;

  std::shared_ptr<const StoredCloud> cloud_;
  QueryPlan plan_;
  ColumnSelection columns_;
  SourceDescription description_;
  bool fitsSteps_ = false; ///< all positions are steps of 32 bits from the grid's offset
};

} // namespace pointfront
