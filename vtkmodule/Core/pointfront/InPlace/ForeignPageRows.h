#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/InPlace/ForeignNodes.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A node's row, and where its points are.
struct ForeignRow
{
  Node row;
  ForeignNode cell;
  /// Number among the page's references: a page of its own has this node and all below it, and the
  /// row here is no more than its place.
  std::optional<std::size_t> page;
};

/// The cube of a foreign octree, by which cells become boxes.
struct ForeignCells
{
  glm::dvec3 low{ 0.0 };
  double side = 0.0;
  double spacing = 0.0; ///< the root's
  glm::dvec3 margin{ 0.0 }; ///< boxes are so much wider than the cells
  std::optional<Bounds> cut; ///< boxes end at it

  Node rowOf(const ForeignNode& cell) const;
  void setBox(Node& node, const Bounds& box) const;
  void cutRow(Node& node) const;
};

/// The rows of a page, breadth first, its root's first. Links are places in `rows`; numbers of
/// points count from the page's first.
struct ForeignPageRows
{
  std::vector<ForeignRow> rows;
  std::vector<ForeignNode> pages; ///< in the order of their rows
  std::uint64_t points = 0; ///< those of its own nodes
  std::uint32_t levels = 0; ///< those down to its deepest row

  /// Cells above others that the page does not name become nodes without points.
  /// `claimed`  points that the page should have with all pages below it; `root` its cell
  /// Errors     BadFormat: a cell that is none, is there twice, lies outside of the root's, or
  ///            below one that has a page of its own; more than maxNodePoints points.
  static Result<ForeignPageRows> make(const ForeignPage& page, const ForeignNode& root,
    std::uint64_t claimed, const ForeignCells& cells, const std::string& path);
};

} // namespace pointfront
