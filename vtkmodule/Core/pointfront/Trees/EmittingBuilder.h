#pragma once

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Trees/NodeEmitter.h"
#include "pointfront/Trees/NodeSplat.h"
#include "pointfront/Trees/Sampler.h"
#include "pointfront/Trees/SparsePoints.h"
#include "pointfront/Trees/TreeBuilder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace pointfront
{

/// Common part of builders of every kind of tree: they sort the records of a part, measure leaves,
/// encode finished nodes and keep these until they are taken.
class EmittingBuilder : public TreeBuilder
{
public:
  std::vector<EmittedNode> takeEmitted() final { return std::exchange(emitted_, {}); }
  const SubtreeSeconds& seconds() const final { return seconds_; }

protected:
  /// `recordBytes`: of a record of the pool.
  EmittingBuilder(const NodeEmitter& emitter, std::size_t recordBytes)
    : recordBytes_(recordBytes)
    , splat_(emitter.space())
    , emitter_(emitter)
  {
  }

  const TreeSpace& space() const { return emitter_.space(); }
  /// The records in Morton order, until the next call. `seen(i, record)` is called for each of
  /// them in that order.
  template <typename Seen>
  RecordSpan sorted(std::vector<std::byte> records, std::size_t count, const Seen& seen)
  {
    const CpuStopwatch watch(seconds_.sort);
    const RecordSpan view{ records.data(), recordBytes_ };
    sorted_.resize(std::max(sorted_.size(), records.size()));
    gatherRecords(view, mortonOrder(view, count), sorted_.data(), seen);
    return { sorted_.data(), recordBytes_ };
  }
  /// The node of a leaf with these points, in Morton order, in a cell of 2^log2Side steps.
  std::unique_ptr<BuiltNode> leafNode(const RecordSpan& positions,
    const std::vector<std::uint32_t>& held, const CellOccupancy& occupancy, unsigned log2Side)
  {
    auto node = std::make_unique<BuiltNode>();
    const double steps = surfaceSpacing(occupancy, log2Side);
    node->row.spacing = static_cast<float>(steps * space().stepLength());
    node->row.splatRadius = splat_.measure(positions, held);
    return node;
  }
  /// Raises the spacing of unevenly dense points to what the sparse ones need, and at most to
  /// `most` world units; BuiltTree keeps it below that of the node above. `held`: a node's own
  /// points, in Morton order.
  void seeSparse(BuiltNode& leaf, const RecordSpan& positions,
    const std::vector<std::uint32_t>& held, float most = std::numeric_limits<float>::max()) const
  {
    const double sparse = space().stepLength() * sparseSpacing(positions, held);
    const double bounded = std::min(double(most), sparse);
    if (bounded >= unevenFrom * leaf.row.spacing)
    {
      leaf.row.spacing = static_cast<float>(bounded);
    }
  }
  /// `points` in Morton order; the children of `node` are finished.
  void emit(BuiltNode& node, const RecordSpan& records, const std::vector<std::uint32_t>& points)
  {
    const CpuStopwatch watch(seconds_.encode);
    EncodedNode payload = emitter_.emit(node, records, points);
    emitted_.push_back({ &node, std::move(payload), node.row.pointsBelow });
  }
  /// Says that the last `count` nodes that were emitted have one parent.
  void adoptEmitted(std::size_t count)
  {
    std::uint64_t below = 0;
    for (auto node = emitted_.end() - static_cast<std::ptrdiff_t>(count); node != emitted_.end();
         ++node)
    {
      below += node->node->row.pointsBelow;
    }
    for (auto node = emitted_.end() - static_cast<std::ptrdiff_t>(count); node != emitted_.end();
         ++node)
    {
      node->pointsAround = below;
    }
  }
  /// With all records that it holds, of `recordBytes` each. Null for an empty set of points.
  std::unique_ptr<BuiltNode> emitRoot(OpenSubtree subtree, std::size_t recordBytes)
  {
    if (!subtree.root)
    {
      return nullptr;
    }
    std::vector<std::uint32_t> all(subtree.records.size() / recordBytes);
    std::iota(all.begin(), all.end(), 0u);
    const RecordSpan records{ subtree.records.data(), recordBytes };
    if (subtree.root->children.empty())
    {
      seeSparse(*subtree.root, records, all);
    }
    emit(*subtree.root, records, all);
    return std::move(subtree.root);
  }

  /// Leaves whose sparse points need less than that many times their spacing are as even as real
  /// surveys are. More points of those would be drawn for no gap that anybody sees.
  static constexpr double unevenFrom = 2.0;

  std::size_t recordBytes_;
  NodeSplat splat_;
  SubtreeSeconds seconds_;

private:
  const NodeEmitter& emitter_;
  std::vector<EmittedNode> emitted_;
  // Reused from part to part: fresh memory costs more than what is done with it.
  std::vector<std::byte> sorted_;
};

} // namespace pointfront
