#pragma once

#include "pointfront/Means/MeanCells.h"
#include "pointfront/Trees/EmittingBuilder.h"
#include "pointfront/Trees/Sampler.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// Common part of builders of trees with `replace` refinement, whatever divides the tree: the
/// points of the input are in the leaves, an inner node holds mean representatives (MeanCells.h).
/// An open subtree holds the representatives of its root, or the points of a leaf, as records of
/// MeanRecord in Morton order.
class MeanBuilder : public EmittingBuilder
{
public:
  std::unique_ptr<BuiltNode> close(OpenSubtree subtree) final
  {
    return emitRoot(std::move(subtree), meanBytes());
  }

protected:
  struct Branch
  {
    std::unique_ptr<BuiltNode> node;
    std::vector<std::byte> means; ///< the records that `view` shows of an inner node built here
    RecordSpan view;
    bool original = false; ///< the view shows records of the pool
    std::vector<std::uint32_t> held; ///< numbers in the view, Morton order
    std::optional<CellOccupancy> occupancy; ///< occupancy of `held`, where it is known already
  };

  /// `leastShare`: as MeanCells has it.
  MeanBuilder(const NodeEmitter& emitter, std::size_t recordBytes, MeanRecord form,
    const SamplingRule& rule, unsigned leastShare);

  std::size_t meanBytes() const { return cells_.form().bytes(); }
  /// Records of a part in Morton order, until the next call.
  RecordSpan sortedRecords(std::vector<std::byte> records, std::size_t count);
  Branch leaf(const RecordSpan& records, std::vector<std::uint32_t> held);
  /// The branch of a finished subtree: `view` shows its representatives, the first one is number
  /// `first`.
  Branch reopened(OpenSubtree& subtree, const RecordSpan& view, std::uint32_t first) const;
  /// Makes the representatives of what is in cells_, which is what the children hold: at least
  /// twice as far apart as those of any child, so that the spacing of each node is the edge of its
  /// cells. The other arguments are those of MeanCells::represent().
  Branch represented(
    const CellOccupancy& occupancy, unsigned log2Side, const std::vector<Branch>& children);
  /// Emits the children, which become those of the node of `parent`.
  void adopt(Branch& parent, std::vector<Branch> children);
  OpenSubtree opened(Branch branch);

  MeanCells cells_; ///< cells of the node at hand
};

} // namespace pointfront
