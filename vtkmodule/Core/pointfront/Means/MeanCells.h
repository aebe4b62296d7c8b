#pragma once

#include "pointfront/Means/MeanRecord.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Trees/BuiltTree.h"
#include "pointfront/Trees/Sampler.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pointfront
{

/// Makes a node's representatives from the points or representatives that its children hold: one
/// for each cell of its grid (MeanRecord.h). Cells are so coarse that a representative stands in
/// for `leastShare` points or representatives at least, on average.
/// Threads  one a thread.
/// Source   Richter & Doellner 2010, section 3.1 and figure 3.
class MeanCells
{
public:
  MeanCells(MeanRecord form, const SamplingRule& rule, unsigned leastShare)
    : form_(std::move(form))
    , rule_(rule)
    , leastShare_(leastShare)
  {
  }

  const MeanRecord& form() const { return form_; }
  void clear();
  /// Records with these numbers, in Morton order; `original`: of the pool. They must outlive the
  /// next represent().
  void add(const RecordSpan& records, const std::vector<std::uint32_t>& held, bool original);
  std::size_t size() const { return inputs_.size(); }
  const TreePosition& position(std::size_t i) const { return positions_[i]; }
  /// Puts all of them into Morton order: needed where what was added lies in between each other.
  /// Equal positions keep their order.
  void sort();
  /// Occupancy of all of them, in Morton order.
  CellOccupancy occupancy() const;

  /// The representatives, packed, in Morton order. `log2Side`: of the cell of the tree that holds
  /// all; `finest`: log2 of the finest cells that may be chosen.
  /// Sets the node's spacing and samplingQuarters.
  std::vector<std::byte> represent(const CellOccupancy& occupancy, unsigned log2Side,
    unsigned finest, double stepLength, BuiltNode& node);
  /// A leaf's records as those of representatives that stand for one point each.
  std::vector<std::byte> alone(const RecordSpan& records, const std::vector<std::uint32_t>& held);

private:
  MeanRecord form_;
  SamplingRule rule_;
  unsigned leastShare_;
  std::vector<MeanInput> inputs_;
  std::vector<TreePosition> positions_; // positions of inputs_
};

} // namespace pointfront
