#pragma once

#include "pointfront/Store/StoreWriter.h"
#include "pointfront/Trees/BuiltTree.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Encoded nodes of one task, in the order in which they belong into the file.
struct EmittedNode
{
  BuiltNode* node = nullptr; ///< where the payload's id goes
  EncodedNode payload;
  /// Points of the input below the parent, as far as the builder knows; below a root: the most.
  std::uint64_t pointsAround = 0;
};

/// A subtree whose nodes above still want something of it.
struct OpenSubtree
{
  std::unique_ptr<BuiltNode> root; ///< null for an empty set of points
  std::vector<std::byte> records; ///< packed points that the levels above may take or summarise
};

/// CPU seconds by phase.
struct SubtreeSeconds
{
  double sort = 0.0;
  double sample = 0.0;
  double encode = 0.0;
};

/// How the nodes of one kind of tree are made of the points of parts, and the upper nodes of what
/// their parts hand up. `node` is the number of a node of the upper tree (PartTree.h).
/// Guarantees  the same subtree for the same points, whatever was built before.
/// Threads     one instance a thread.
class TreeBuilder
{
public:
  virtual ~TreeBuilder() = default;
  /// Over the records of the part `node`, in the order in which the pool gives them.
  virtual OpenSubtree build(
    std::vector<std::byte> records, std::size_t count, std::uint32_t node) = 0;
  /// The node above `children`, which come in their order.
  virtual OpenSubtree join(std::vector<OpenSubtree> children, std::uint32_t node) = 0;
  /// There is nothing above.
  virtual std::unique_ptr<BuiltNode> close(OpenSubtree subtree) = 0;
  /// The nodes that were emitted since the last call.
  virtual std::vector<EmittedNode> takeEmitted() = 0;
  /// Times of all calls.
  virtual const SubtreeSeconds& seconds() const = 0;
};

} // namespace pointfront
