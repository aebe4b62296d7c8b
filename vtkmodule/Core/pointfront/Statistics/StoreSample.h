#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodeReader.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pointfront
{

/// A fair, small subset of a cloud: the points of its coarsest levels. Enough to see how values
/// spread before anything is drawn (ranges of colour maps, a typical height).
/// Cost  reads the roots, and whole levels below them until there are some ten thousand points; of
///       a large node its first ones.
class StoreSample
{
public:
  /// Positions and the columns of `selection`.
  static Result<StoreSample> read(const Hierarchy& hierarchy, const NodeReader& reader,
    const QuantisationGrid& grid, const AttributeSchema& schema, const ColumnSelection& selection);

  std::size_t size() const { return elevations_.size(); }
  /// World z that the share of points is below: 0.5 is the median. 0 without points.
  double elevationQuantile(double share) const;
  /// Likewise of one component of selection[column], as stored (before scale and offset). NaN
  /// and infinite values are left out.
  double columnQuantile(std::size_t column, std::size_t component, double share) const;

private:
  std::vector<double> elevations_; ///< sorted
  std::vector<std::vector<std::vector<double>>> columns_; ///< [column][component], sorted
};

} // namespace pointfront
