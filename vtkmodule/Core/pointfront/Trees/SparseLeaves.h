#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// How much farther apart than the mean the sparse points of each square of a tree lie.
/// Need     An inner node draws one point of so many, everywhere. The mean spacing of its square,
///          sqrt(area / points), may be far below that of its sparse part: a scanner on a tripod
///          has nearly all points around its feet.
/// Measure  a tenth of the area is of leaves with this spacing or a wider one. Of points it may be
///          far less: seen from afar, the many points of the dense part share few pixels.
/// Uneven   is a square of which that is at least twice the mean. Squares of strips that overlap
///          are less uneven, and keep their mean.
/// Cost     a sort of the leaves, and their number times the depth of the tree.
class SparseLeaves
{
public:
  struct Square
  {
    NodeIndex parent = noNode;
    bool whole = false; ///< a leaf, or a place whose slices are leaves: its area counts
    double area = 0.0;
    double spacing = 0.0; ///< mean of its points
  };
  explicit SparseLeaves(const std::vector<Square>& squares);

  /// The spacing of the sparse points over the mean; 1: they are even.
  double ratio(NodeIndex square) const { return ratios_[square]; }

private:
  std::vector<float> ratios_;
};

} // namespace pointfront
