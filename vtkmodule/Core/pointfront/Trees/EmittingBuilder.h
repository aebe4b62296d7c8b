#pragma once

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Trees/NodeEmitter.h"
#include "pointfront/Trees/TreeBuilder.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace pointfront
{

/// What builders of every kind of tree do with finished nodes: encode them, and keep them until
/// they are taken.
class EmittingBuilder : public TreeBuilder
{
public:
  std::vector<EmittedNode> takeEmitted() final { return std::exchange(emitted_, {}); }
  const SubtreeSeconds& seconds() const final { return seconds_; }

protected:
  explicit EmittingBuilder(const NodeEmitter& emitter)
    : emitter_(emitter)
  {
  }

  const TreeSpace& space() const { return emitter_.space(); }
  /// `points` in Morton order; the children of `node` are finished.
  void emit(BuiltNode& node, const RecordSpan& records, const std::vector<std::uint32_t>& points)
  {
    const CpuStopwatch watch(seconds_.encode);
    EncodedNode payload = emitter_.emit(node, records, points);
    emitted_.push_back({ &node, std::move(payload) });
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
    emit(*subtree.root, { subtree.records.data(), recordBytes }, all);
    return std::move(subtree.root);
  }

  SubtreeSeconds seconds_;

private:
  const NodeEmitter& emitter_;
  std::vector<EmittedNode> emitted_;
};

} // namespace pointfront
