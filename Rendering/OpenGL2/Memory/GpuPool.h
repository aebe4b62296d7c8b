#pragma once

#include "DrawRuns.h"
#include "GpuMemory.h"
#include "LayerStreams.h"

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Store/NodeReader.h"

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pointfront
{

class GpuAccount;

/// The nodes of one cloud that are on the GPU, in the slots of a GpuMemory. A node takes as many
/// slots as its drawn prefix fills. A node that is no longer drawn stays until its slots are
/// wanted; the least recently drawn node goes first. The clouds of a window share its budgets. A
/// pool gives memory back if its limit is less than half of its size, or if another pool wants its
/// idle memory. Guarantees  a node that any view has drawn within the last `views` frames is never
/// evicted, even
///             if that exceeds the limit of points. The limit of bytes always holds: in the first
///             frame after it was lowered only nodes that this frame draws stay, the nearest ones
///             if not all fit.
/// Threads     one thread, that of the GL context, which must be current in every function but
///             the constructor and the destructor. Destruction without release() leaks the buffers
///             to the context, which is gone then.
class GpuPool
{
public:
  static constexpr std::uint32_t slotPoints = gpuSlotPoints;
  /// The items of a plan that a frame draws, near to far.
  using DrawList = std::vector<const PlanItem*>;

  struct Entry
  {
    std::vector<std::uint32_t> slots;
    std::uint32_t points = 0; ///< uploaded positions: a prefix of the node
    /// Uploaded values of each stream of its layer: prefixes.
    std::array<std::uint32_t, gpuStreamCount> filled{};
    std::uint16_t layer = 0;
    std::uint32_t wanted = 0; ///< most points that a view draws of it
    std::uint64_t frame = 0; ///< last drawn

    std::uint32_t values(GpuStream stream) const
    {
      return filled[static_cast<std::size_t>(stream)];
    }
  };
  /// The limits of a frame.
  struct Limits
  {
    std::uint64_t points = 0; ///< drawn at a time; 0: no limit
    std::int64_t bytes = 0; ///< bytes of all pools of the window; 0: no limit
    std::uint32_t views = 1; ///< that take turns
  };

  GpuPool() = default;
  ~GpuPool();
  GpuPool(const GpuPool&) = delete;
  GpuPool& operator=(const GpuPool&) = delete;

  /// Sets the account of the window. Called before any other function in a context.
  void enter(std::shared_ptr<GpuAccount> account);
  /// Sets the streams of each layer by its number; a layer without an entry has positions only. If
  /// the new styles fill a stream in another way, its values are uploaded again as nodes are drawn;
  /// everything else stays.
  void setStreams(std::vector<LayerStreams> byLayer);
  void beginFrame(const Limits& limits);
  /// Whether this frame's limit of bytes is lower than that of the frame before, and was exceeded.
  bool lowered() const { return lowered_; }
  /// Called before a frame's first bring() with everything that the frame draws. False if the
  /// budget of bytes does not hold all of it: bring() then brings as much as there is room for.
  bool makeRoom(const DrawList& draw);

  /// Tells that nothing of the pool is drawn until the next frame: all of it may be given back.
  void leaveScreen();

  /// Brings the first `count` points of `node` and their streams, as far as the node has the
  /// columns, to the GPU. Positions beyond `bytesLeft` wait for another frame; bytesLeft falls by
  /// what is uploaded. Null when nothing of the node is there yet.
  const Entry* bring(
    const NodeColumns& node, std::uint32_t count, const FramePlan& plan, std::int64_t& bytesLeft);
  /// Points [first, end) of a node, to be drawn.
  void addRuns(const Entry& entry, std::uint32_t first, std::uint32_t end, DrawRuns& runs) const;
  /// The streams of a layer, by its number.
  const LayerStreams& streamsOf(std::uint16_t layer) const;
  /// Whether the positions and all streams of the node's first `count` points are on the GPU.
  bool isFilled(const Entry& entry, std::uint32_t count) const;
  /// The entry of a node on the GPU, or null.
  const Entry* find(NodeIndex node) const;

  const GpuMemory& memory() const { return memory_; }
  /// True once after the GPU had less memory than the budgets allow.
  bool takeRefused() { return memory_.takeRefused(); }
  /// All bytes uploaded so far: positions and values.
  std::uint64_t uploadedBytes() const { return uploaded_; }

  /// The last block, if what is drawn finds room in the others; false if not.
  bool giveBack();
  /// Gives all buffers back.
  void release();

private:
  void mark(const DrawList& draw);
  void keepWithin(const DrawList& draw);
  void addStreams();
  bool makeFree(std::uint64_t slots);
  bool isIdle(const Entry& entry) const;
  void listIdle();
  bool evictListed();
  bool evictOne();
  bool trim();
  bool grow(std::uint64_t slots);
  void uploadPositions(const NodeColumns& node, Entry& entry, std::uint32_t end);
  void uploadStream(GpuStream stream, const NodeColumns& node, const FramePlan& plan, Entry& entry,
    std::uint32_t end);

  GpuMemory memory_;
  std::vector<LayerStreams> streams_; ///< by layer
  std::unordered_map<NodeIndex, Entry> entries_;
  /// Last drawn, node: the oldest at the end, of those drawn last together the deepest.
  std::vector<std::pair<std::uint64_t, NodeIndex>> idle_;
  std::vector<std::uint32_t> staging_;
  Limits limits_;
  bool lowered_ = false;
  std::uint32_t slotLimit_ = 0; ///< for `points`: grows beyond for what is on screen; 0: none
  std::uint64_t frame_ = 0;
  std::uint64_t uploaded_ = 0;
};

} // namespace pointfront
