#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/NodeReader.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace pointfront
{

class ClassHeights;

/// A number of a condition: a double, or a whole number of 64 bits, of which a double loses digits.
using ConditionNumber = long double;

/// One condition on one attribute of a store, on a coordinate, or on what is derived of them
/// (PointColouring.h): within a range, or one of some values.
/// Units    world values: stored * scale + offset.
/// Numbers  integers of 64 bits without scale and offset are compared exactly. Everything else is a
///          double, and is compared with the doubles of the condition's numbers.
struct AttributeCondition
{
  std::uint32_t column = 0;
  int component = 0;
  int axis = -1; ///< 0 x, 1 y, 2 z: of the position, which needs no column
  double axisScale = 1.0; ///< scale of the store's grid, along `axis`
  double axisOffset = 0.0;
  /// Whether the value's sign is left out: horizontality is so of the normal's third component.
  bool absolute = false;
  /// Global height: `axis` is z, and the value is the point's height in its class.
  std::shared_ptr<const ClassHeights> heights = nullptr;
  std::array<ConditionNumber, 2> range{ -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
  bool lowOpen = false; ///< range[0] itself does not pass
  bool highOpen = false; ///< range[1] itself does not pass
  std::vector<ConditionNumber> values; ///< ascending; not empty: one of these, whatever the range
  bool inverted = false; ///< values pass that would not, and the other way round; NaN never does

  /// Its numbers become the doubles that points are compared as, where they are written as info
  /// and exports write a value: the double of 9983 steps of 0.0001 is not that of 0.9983, and that
  /// of the float 8.604 is not that of 8.604. All others stay. `attribute`: null for a coordinate.
  void takeAsWritten(const Attribute* attribute);
  bool passes(double value) const;
  /// False when no value passes whose double lies in [low, high]: a node of that range need not be
  /// read. True where doubles cannot tell.
  bool mayPass(double low, double high) const;
  bool usesColumn() const { return axis < 0; }
  /// The range with both ends closed: the same doubles pass.
  std::array<double, 2> closedRange() const;
  friend bool operator==(const AttributeCondition& a, const AttributeCondition& b)
  {
    return a.column == b.column && a.component == b.component && a.axis == b.axis &&
      a.axisScale == b.axisScale && a.axisOffset == b.axisOffset && a.range == b.range &&
      a.lowOpen == b.lowOpen && a.highOpen == b.highOpen && a.values == b.values &&
      a.inverted == b.inverted && a.absolute == b.absolute && a.heights == b.heights;
  }
};

/// Which points are drawn: those that meet all conditions.
/// Threads  a value; const functions from any thread.
struct PointFilter
{
  std::vector<AttributeCondition> conditions;

  bool empty() const { return conditions.empty(); }
  /// The columns that it reads, ascending.
  ColumnSelection columns() const;
  /// keep[i] = 1 for points of [first, first + count) of the node that pass, else 0. The node has
  /// the columns. Exactly AttributeCondition::passes() of each point's world values.
  /// Cost  0.1 to 2 ns a point and condition; sets of more than one double take a few more.
  void evaluate(const NodeColumns& node, const AttributeSchema& schema, std::uint32_t first,
    std::uint32_t count, std::uint8_t* keep) const;

  friend bool operator==(const PointFilter& a, const PointFilter& b)
  {
    return a.conditions == b.conditions;
  }
};

} // namespace pointfront
