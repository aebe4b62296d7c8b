#pragma once

#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfrontRenderingCoreModule.h" // for the export macro

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// How VTK wants colours: the part of vtkMapper's and its lookup table's properties that decides
/// which column is needed and what is made of it. What the table says of a value is not part of it.
struct ColourRequest
{
  enum class Mode
  {
    Default, ///< bytes (and "rgb" of 16 bits) are colours, all else goes through the table
    Table,   ///< everything through the table
    Direct   ///< whatever has three or four components is a colour
  };
  std::string name; ///< of the attribute; empty: the property's colour
  Mode mode = Mode::Default;
  int component = -1; ///< -1: the magnitude of several
};

/// What colours the points: which column is read, and how a point's bytes become the one 32-bit
/// value that it has on the GPU. "Model only what a scene requires": flat colour and elevation need
/// no column and no value.
/// Threads  a value; const functions from any thread.
struct POINTFRONTRENDERINGCORE_EXPORT PointColouring
{
  enum class Kind
  {
    Flat,     ///< the property's colour
    Direct,   ///< the value is four bytes r, g, b, a
    Table,    ///< the value is a float: world value - base, to be looked up
    Elevation ///< the point's z, computed in the shader, to be looked up
  };
  Kind kind = Kind::Flat;
  std::uint32_t column = 0;
  int component = 0; ///< -1: magnitude
  double base = 0.0; ///< world value that float 0 stands for: floats keep large GPS times apart
  bool wide = false; ///< Direct: integer components use all bits of their type
  /// Table: world values are the integers of this range, few enough for a table of one entry each.
  std::optional<std::array<std::int64_t, 2>> integers;

  /// How `request` is met with that store; nothing when no attribute has that name.
  static std::optional<PointColouring> choose(
    const StoreDescription& description, const ColourRequest& request);

  bool usesColumn() const { return kind == Kind::Direct || kind == Kind::Table; }
  bool usesTable() const { return kind == Kind::Table || kind == Kind::Elevation; }
  /// What has to be read for it.
  ColumnSelection columns() const;
  /// True if `node` was read with what this colouring needs.
  bool coveredBy(const NodeColumns& node) const;

  /// Values of points [first, first + count) of a node that covers this colouring. Appends.
  void encode(const NodeColumns& node, const Attribute& attribute, std::uint32_t first,
    std::uint32_t count, std::vector<std::uint32_t>& values) const;

  friend bool operator==(const PointColouring& a, const PointColouring& b)
  {
    return a.kind == b.kind && a.column == b.column && a.component == b.component &&
           a.base == b.base && a.wide == b.wide;
  }
  friend bool operator!=(const PointColouring& a, const PointColouring& b) { return !(a == b); }
};

} // namespace pointfront
