#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <array>
#include <memory>
#include <vector>

namespace pointfront
{

/// Global height (Richter, Discher & Doellner 2015, section 3.1): how high a point lies among all
/// points of its object class, from 0, the lowest, to 1. The classes are the store's layers; in a
/// store without layers all points are one class.
/// Cost     no store holds it: it is computed from z when a point is drawn or judged.
/// Threads  const functions from any thread.
class ClassHeights
{
public:
  explicit ClassHeights(std::shared_ptr<const StoredCloud> store);
  ClassHeights(const StoreDescription& store, const Hierarchy& hierarchy);

  /// Null if it was made of a description.
  const std::shared_ptr<const StoredCloud>& store() const { return store_; }
  /// Appends the heights of the points [first, first + count) of a node; 0.5 if the class has one
  /// height only.
  void append(const NodeColumns& node, std::uint32_t first, std::uint32_t count,
    std::vector<float>& heights) const;
  /// The height of one point.
  double at(const NodeColumns& node, std::uint32_t point) const;
  /// The heights of all points with world z in [low, high], of whatever class.
  std::array<double, 2> between(double low, double high) const;

private:
  static double heightOf(double z, const std::array<double, 2>& range);

  std::shared_ptr<const StoredCloud> store_;
  QuantisationGrid grid_;
  std::vector<std::array<double, 2>> ranges_; ///< world z of each layer; low > high: no points
};

} // namespace pointfront
