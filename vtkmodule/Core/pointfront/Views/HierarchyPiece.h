#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <memory>

namespace pointfront
{

/// The share of a hierarchy that one of several processes draws (sort-last rendering).
/// Shapes      whole subtrees, neighbours in depth-first order; all pieces have about as many
///             points. A node above the subtrees is in every piece that has nodes below it, but
///             only one piece has its points; in the others its point count is 0. With
///             Refinement::Replace each of these pieces has its representatives, to show them until
///             its own part of the children is loaded.
/// Numbers     nodes keep their numbers in the store: the piece is the store's table with a few
///             changed rows (those above the subtrees). Walking down from its roots one meets the
///             piece.
/// Guarantees  the pieces together have every point of the input once. Piece 0 of 1 is the
///             hierarchy itself. Takes time and memory for the changed rows only, whatever the
///             size of the table.
class HierarchyPiece
{
public:
  HierarchyPiece(std::shared_ptr<const Hierarchy> whole, int piece, int pieces);

  const std::shared_ptr<const Hierarchy>& hierarchy() const { return part_; }
  const std::shared_ptr<const Hierarchy>& whole() const { return whole_; }
  bool isWhole() const { return part_ == whole_; }

  /// Whether this piece has points of a node of the whole hierarchy. False while rows between the
  /// node and its root are not in memory: does not wait.
  bool has(NodeIndex node) const;

private:
  class ChangedTable;
  std::shared_ptr<const Hierarchy> whole_;
  std::shared_ptr<const Hierarchy> part_;
  std::shared_ptr<const ChangedTable> changed_; ///< null: the whole hierarchy
};

} // namespace pointfront
