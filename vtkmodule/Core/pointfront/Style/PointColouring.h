#pragma once

#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/ColourMap.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{
class ClassHeights;

/// The colours that VTK asks for: those properties of vtkMapper and its lookup table that decide
/// which column is needed and how it is used. The colours in the table are not part of it.
struct ColourRequest
{
  enum class Mode
  {
    Default, ///< bytes (and "rgb" of 16 bits) are colours, all else goes through the table
    Table, ///< everything through the table
    Direct ///< whatever has three or four components is a colour
  };
  std::string name; ///< name of the attribute; empty: the property's colour
  Mode mode = Mode::Default;
  int component = -1; ///< -1: the magnitude of several
  /// Direct: the values of floating or scaled components that are black and full (a lookup table
  /// of vector mode RGB colours has such a range). {-1, 1} shows a normal as a colour.
  std::array<double, 2> colourRange{ 0.0, 1.0 };
  /// Table: values of a 16-bit "rgb" that is a colour count by their upper bytes, as VTK's arrays
  /// of it do.
  bool coloursInBytes = false;
};

/// From a stored component to 0..255: byte = stored * factor + offset, clamped.
struct ColourScale
{
  double factor = 1.0;
  double offset = 0.0;

  /// `wide`: integer components use all bits of their type. `range`: as ColourRequest::colourRange.
  ColourScale(const Attribute& attribute, bool wide, const std::array<double, 2>& range);
};

/// The colouring of points: which column is read, and how a point's bytes become the one 32-bit
/// value that it has on the GPU. "Model only what a scene requires": flat colour and elevation need
/// no column and no value.
/// Derived  three attributes that no store holds are made of what it has, unless it has one of
///          that name: "elevation" is z; "horizontality" is the absolute third component of
///          "normal", 1 on a flat roof and 0 on a wall; "global_height" is ClassHeights.
/// Source   the last two: Richter, Discher & Doellner 2015, section 3.1.
/// Threads  a value; const functions from any thread.
struct PointColouring
{
  enum class Kind
  {
    Flat, ///< the property's colour
    Direct, ///< the value is four bytes r, g, b, a
    Table, ///< the value is a float, to be looked up: floatOf() the world value
    Elevation ///< the point's z, computed in the shader, to be looked up
  };
  Kind kind = Kind::Flat;
  std::uint32_t column = 0;
  int component = 0; ///< -1: magnitude
  /// World value that float 0 stands for: floats keep large GPS times apart. Finite.
  double base = 0.0;
  /// Table: world units from float 0 to 1; a power of 2, 1 unless the range of the colours is
  /// beyond floats. Elevation: heights are in world units, and all are 0 beside a range that has a
  /// unit.
  double unit = 1.0;
  bool decades = false; ///< Table: floats are logarithms to base 10 of world values
  bool exact = false; ///< Table: floats hold all values less the column's lowest one as they are
  bool absolute = false; ///< Table: of the component
  /// Direct: integer components use all bits of their type. Table: values are their upper bytes.
  bool wide = false;
  std::array<double, 2> colourRange{ 0.0, 1.0 }; ///< Direct: as in ColourRequest
  /// Table: the value is a point's height in its class, of no column.
  std::shared_ptr<const ClassHeights> heights;
  /// Table: world values are the integers of this range, few enough for a table of one entry each.
  std::optional<std::array<std::int64_t, 2>> integers;

  /// The colouring that meets `request` with that store; nothing when no attribute has that name.
  /// `heights` are needed if wantsHeights() is true.
  static std::optional<PointColouring> choose(const StoreDescription& description,
    const ColourRequest& request, std::shared_ptr<const ClassHeights> heights = nullptr);
  static bool wantsHeights(const StoreDescription& description, const ColourRequest& request);
  /// Makes floats of values in the range of `map` as fine as its entries.
  /// Base       moves to the range where floats so far from it are coarser than entries: one GPS
  ///            time of 0, or one "no data" of -3.4e38, would give all other points one colour.
  ///            Values far from the range lose digits instead, and have the colours of its ends.
  /// Stays      where it is as far as floats allow, and on a grid of many widths of the range
  ///            beyond: another base means that all values are uploaded again.
  /// Unit       for a range that floats do not hold, 1e200 to 1e201; decades for a logarithmic one.
  void fitTo(const ColourMap& map);

  /// Whether a point has a value on the GPU.
  bool hasValues() const { return kind == Kind::Direct || kind == Kind::Table; }
  bool usesColumn() const { return hasValues() && !heights; }
  bool usesTable() const { return kind == Kind::Table || kind == Kind::Elevation; }
  /// The columns that it reads.
  ColumnSelection columns() const;
  /// True if `node` was read with what this colouring needs.
  bool coveredBy(const NodeColumns& node) const;

  /// Table: the value of a point's bytes, which begin at `point`; one component, or the magnitude
  /// of all.
  double valueOf(const Attribute& attribute, const std::byte* point) const;
  float floatOf(double value) const; ///< Table: the value on the GPU; base, unit and decades
  /// Values of points [first, first + count) of a node that covers this colouring. Appends.
  void encode(const NodeColumns& node, const AttributeSchema& schema, std::uint32_t first,
    std::uint32_t count, std::vector<std::uint32_t>& values) const;

  friend bool operator==(const PointColouring& a, const PointColouring& b)
  {
    return a.kind == b.kind && a.column == b.column && a.component == b.component &&
      a.base == b.base && a.unit == b.unit && a.decades == b.decades && a.absolute == b.absolute &&
      a.wide == b.wide && a.colourRange == b.colourRange && a.heights == b.heights &&
      a.exact == b.exact && a.integers == b.integers;
  }
  friend bool operator!=(const PointColouring& a, const PointColouring& b) { return !(a == b); }

private:
  void moveBase(const ColourMap& map);
  double inBytes(double value) const;
  static std::optional<PointColouring> derived(const StoreDescription& description,
    const ColourRequest& request, std::shared_ptr<const ClassHeights> heights);
  void encodeColours(const std::byte* point, const Attribute& attribute, std::uint32_t count,
    std::vector<std::uint32_t>& values) const;
  void encodeNumbers(const std::byte* point, const Attribute& attribute, std::uint32_t count,
    std::vector<std::uint32_t>& values) const;
};

} // namespace pointfront
