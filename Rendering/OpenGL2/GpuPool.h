#pragma once

#include "PointColouring.h"

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Store/NodeReader.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace pointfront
{

/// GPU memory of one cloud in one GL context: a vertex buffer of equal slots, and beside it one of
/// values, made only when a colouring needs values. A node takes as many slots as its drawn prefix
/// fills; what is no longer drawn stays until its slots are wanted, least recently drawn first.
/// The clouds of a window share its budget: a pool that may have less than half of what it has
/// gives memory back.
/// Units       a vertex is 12 bytes of position (three unsigned grid steps) and 4 bytes of value.
/// Guarantees  a node that any view has drawn within the last `views` frames is never evicted: what
///             is on screen stays, even when that takes more than the limit of points.
/// Threads     one thread, that of the GL context, which must be current in every function but
///             the constructor and the destructor. Destruction without release() leaks the buffers
///             to the context, which is gone then.
class GpuPool
{
public:
  static constexpr std::uint32_t slotPoints = 4096;

  struct Entry
  {
    std::vector<std::uint32_t> slots;
    std::uint32_t points = 0; ///< uploaded positions: a prefix of the node
    std::uint32_t values = 0; ///< uploaded values of the pool's colouring: a prefix
    std::uint64_t frame = 0;  ///< last drawn
  };

  /// Values of another colouring are worth nothing: they are uploaded again as nodes are drawn.
  void setColouring(const PointColouring& colouring);
  /// A frame begins. `mostPoints` is what may be drawn at a time (0: no limit), `views` how many
  /// views take turns.
  void beginFrame(std::uint64_t mostPoints, std::uint32_t views);

  /// Before a frame's first bring(): the slots that its nodes will take. `copying`: what is there
  /// stays, and for a moment there are two buffers. Else, where there is one view only, a larger
  /// buffer begins empty: for frames that may upload everything again, and no more memory is taken
  /// than there is in the end.
  void makeRoom(std::uint64_t slots, bool copying);

  /// Brings the first `count` points of `node` and their values, as far as the node has the
  /// colouring's column, to the GPU. Positions beyond `bytesLeft` wait for another frame; bytesLeft
  /// falls by what is uploaded. Null when nothing of the node is there yet.
  const Entry* bring(const NodeColumns& node, std::uint32_t count, const Attribute* attribute,
    std::int64_t& bytesLeft);
  /// What is there of a node, or null.
  const Entry* find(NodeIndex node) const;

  std::uint32_t positionBuffer() const { return positions_; }
  std::uint32_t valueBuffer() const { return values_; }
  std::uint32_t slotCount() const { return slotCount_; }
  std::int64_t bytes() const;
  /// Bytes uploaded ever: positions and values.
  std::uint64_t uploadedBytes() const { return uploaded_; }

  /// Gives the buffers back.
  void release();

private:
  bool takeSlot(std::uint32_t& slot);
  bool evictOne();
  void grow();
  void growTo(std::uint32_t slots);
  void shrink();
  void allocateValues();
  void uploadPositions(const NodeColumns& node, Entry& entry, std::uint32_t end);
  void uploadValues(
    const NodeColumns& node, const Attribute& attribute, Entry& entry, std::uint32_t end);

  PointColouring colouring_;
  std::unordered_map<NodeIndex, Entry> entries_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> staging_;
  std::uint32_t positions_ = 0; ///< GL buffers; 0: not made
  std::uint32_t values_ = 0;
  std::uint32_t slotCount_ = 0;
  std::uint32_t slotLimit_ = 0; ///< grows beyond only for what is on screen; 0: no limit
  std::uint32_t views_ = 1;
  std::uint64_t frame_ = 0;
  std::uint64_t uploaded_ = 0;
};

} // namespace pointfront
