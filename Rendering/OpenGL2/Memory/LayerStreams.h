#pragma once

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Style/GpuStreams.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// Fills the streams of one layer's points.
/// Threads  a value; const functions from any thread.
class LayerStreams
{
public:
  using Styles = std::vector<std::shared_ptr<const ResolvedStyle>>;

  LayerStreams() = default; ///< positions alone
  explicit LayerStreams(Styles styles);

  const GpuStreams& streams() const { return streams_; }
  bool has(GpuStream stream) const { return streams_.has(stream); }
  /// Alpha of the points that this style draws, where its set has marks (GpuStreams); else -1.
  int markOf(const ResolvedStyle& style) const;
  /// Whether values that the other object made equal those that this object makes.
  bool fillsAs(const LayerStreams& other, GpuStream stream) const;
  /// Whether the node was read with the columns that the stream needs.
  bool coveredBy(const NodeColumns& node, GpuStream stream) const;
  /// Appends the values of points [first, first + count) of a node that covers the stream.
  void encode(GpuStream stream, const FramePlan& plan, const NodeColumns& node, std::uint32_t first,
    std::uint32_t count, std::vector<std::uint32_t>& values) const;

  /// Marks are of 8 bits, one column of sizes serves all styles of a layer, and so many lenses have
  /// streams.
  static bool canDraw(const Styles& styles);

private:
  const Styles& stylesOf(GpuStream stream) const;
  void encodeShapes(const FramePlan& plan, const NodeColumns& node, std::uint32_t first,
    std::uint32_t count, std::vector<std::uint32_t>& values) const;

  std::array<Styles, gpuValueSets> sets_; ///< valueSetOf()
  GpuStreams streams_;
  std::optional<std::uint32_t> normal_; ///< columns of the store
  std::optional<std::uint32_t> radius_;
  std::optional<std::uint32_t> size_;
  std::optional<std::uint32_t> height_;
};

} // namespace pointfront
