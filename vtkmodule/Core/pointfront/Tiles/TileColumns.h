#pragma once

#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Store/NodeRanges.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <array>
#include <optional>
#include <vector>

namespace pointfront
{

/// How the columns of one tile become those that all tiles have.
/// Lacking  columns are zeros.
/// Threads  const functions from any thread.
class TileColumns
{
public:
  TileColumns(AttributeSchema own, std::vector<ColumnMapping> mappings)
    : own_(std::move(own))
    , mappings_(std::move(mappings))
  {
  }
  /// Codes of radii are multiples of another base here than in the common column.
  void recodeRadii(double ownBase, double commonBase);
  /// Colours have 8 bits here and 16 in the common column: each becomes 257 times as large.
  void widenColours() { colours_ = true; }

  bool lacks(std::size_t column) const { return !mappings_[column].column; }
  bool converts(std::size_t column) const { return mappings_[column].converted; }
  /// The tile's numbers of those of the common columns that it has.
  ColumnSelection own(const ColumnSelection& columns) const;
  /// A node of the tile that was read with own(wanted), as one with the common columns `wanted`.
  void adapt(NodeColumns& node, const ColumnSelection& wanted, const AttributeSchema& common) const;

  /// The tile's component for the component of a common column; nothing: it is lacking.
  std::optional<std::uint32_t> ownComponent(std::size_t column, std::uint32_t component) const;
  /// Values of the tile as stored, as values of the common column.
  ValueRange adapted(const ValueRange& range, std::size_t column, const Attribute& common) const;
  /// Range of all its points; zeros where it lacks the column.
  ColumnRange range(const StoreDescription& own, std::size_t column, const Attribute& common) const;

private:
  void recode(const Attribute& common, std::vector<std::byte>& values) const;

  AttributeSchema own_;
  std::vector<ColumnMapping> mappings_; ///< by common column
  std::optional<std::array<std::byte, 256>> radii_; ///< codes, where their base is another one
  bool colours_ = false; ///< they are widened
};

} // namespace pointfront
