#pragma once

#include "RasterItems.h"
#include "RasterKernels.h"

#include <cstdint>

namespace pointfront
{

/// Radii and normals of points, from the columns of their node, as the loops want them.
/// Threads  a value; const functions from any thread.
class PointShapes
{
public:
  PointShapes(const RasterItems& items, const RasterKernels& kernels)
    : items_(items)
    , kernels_(kernels)
  {
  }
  /// Fills radius (world units, times `share`) and normals, or heights of walls, of projected
  /// points: of [first, first + count), or of those in a list; `grown` says how large those are yet
  /// that grow.
  void fill(
    const RasterItem& item, std::uint32_t first, int count, float share, RasterBatch& batch) const;
  void fill(const RasterItem& item, const std::uint32_t* points, int count, float share,
    RasterBatch& batch) const;

  /// The same for blending: points that grow have their size, and a part of their weight.
  void fillBlended(
    const RasterItem& item, std::uint32_t first, int count, float share, RasterBatch& batch) const;

  /// No point of the item has a larger radius (world units, before a share); infinite where only
  /// reading them all would tell.
  static float largestRadius(const RasterItem& item);
  /// The tallest wall of the item, store units.
  static double largestHeight(const RasterItem& item);

private:
  template <typename Points>
  void fillBy(
    const RasterItem& item, const Points& points, int count, float share, RasterBatch& batch) const;
  template <typename Points>
  static void grow(const RasterItem& item, const Points& points, int count, RasterBatch& batch);
  template <typename Points>
  void fillNormals(
    const RasterItem& item, const Points& points, int count, RasterBatch& batch) const;

  template <typename Points>
  void fillHeights(
    const RasterItem& item, const Points& points, int count, RasterBatch& batch) const;

  const RasterItems& items_;
  const RasterKernels& kernels_;
};

} // namespace pointfront
