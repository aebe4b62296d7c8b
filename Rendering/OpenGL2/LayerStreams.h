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

/// What fills the streams of one layer's points.
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
  /// What was made for the other one is what this one makes.
  bool fillsAs(const LayerStreams& other, GpuStream stream) const;
  /// The node was read with what the stream is made of.
  bool coveredBy(const NodeColumns& node, GpuStream stream) const;
  /// Of points [first, first + count) of a node that covers the stream, appended.
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
