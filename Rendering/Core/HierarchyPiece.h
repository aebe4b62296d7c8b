#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfrontRenderingCoreModule.h" // for the export macro

#include <memory>
#include <vector>

namespace pointfront
{

/// The share of a hierarchy that one of several processes draws (sort-last rendering).
/// Shapes      whole subtrees, neighbours in depth-first order, about as many points in each piece.
///             Nodes above them stand in every piece that has something below them, but only one
///             piece has their points; in the others their point count is 0. With
///             Refinement::Replace each of those pieces has their representatives, to show them
///             until its own part of the children is there.
/// Guarantees  the pieces together have every point of the input once. Piece 0 of 1 is the
///             hierarchy itself, without a copy.
class POINTFRONTRENDERINGCORE_EXPORT HierarchyPiece
{
public:
  HierarchyPiece(std::shared_ptr<const Hierarchy> whole, int piece, int pieces);

  const std::shared_ptr<const Hierarchy>& hierarchy() const { return part_; }
  /// The store's number of a node of the piece.
  NodeIndex toStore(NodeIndex node) const { return toStore_.empty() ? node : toStore_[node]; }
  /// The piece's number of a node of the store; noNode if the piece has it not.
  NodeIndex fromStore(NodeIndex node) const { return fromStore_.empty() ? node : fromStore_[node]; }

private:
  std::shared_ptr<const Hierarchy> part_;
  std::vector<NodeIndex> toStore_;   ///< empty: the same numbers
  std::vector<NodeIndex> fromStore_; ///< empty: the same numbers
};

} // namespace pointfront
