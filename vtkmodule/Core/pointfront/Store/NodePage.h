#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Bytes of one page of a node table, and the rows in it. The last page may have fewer.
constexpr std::size_t nodePageBytes = 4096;
constexpr std::uint32_t nodePageRows = 60;

using NodePage = std::array<Node, nodePageRows>;

/// Pages of a table of so many nodes.
constexpr std::uint32_t nodePageCount(NodeIndex nodes)
{
  return nodes / nodePageRows + (nodes % nodePageRows != 0 ? 1u : 0u);
}
/// Rows of one of them.
constexpr std::uint32_t nodePageLength(NodeIndex nodes, std::uint32_t page)
{
  const NodeIndex left = nodes - page * nodePageRows;
  return left < nodePageRows ? left : nodePageRows;
}

/// What every row must agree with, whatever is in other pages.
struct TableLimits
{
  NodeIndex nodes = 0;
  std::uint32_t layers = 1;
};

/// Appends page number `page`: rows, rank of its first point, its number and a checksum. The rank
/// is that of rows[0].firstPoint.
void encodeNodePage(const Node* rows, std::uint32_t count, std::uint32_t page, std::byte* target);

/// Fills the page's rows (those behind the last are left alone). What is wrong, or an empty text:
/// checksum, page number, and each row on its own (rowFault).
std::string decodeNodePage(
  const std::byte* data, std::uint32_t page, const TableLimits& limits, NodePage& rows);

/// What is wrong with a row by itself, or an empty text: sizes finite and not negative, parent
/// before it, children behind it and inside the table, layer and counts in range.
/// Walks up a table of such rows end, and walks down never leave it.
std::string rowFault(const Node& row, NodeIndex index, const TableLimits& limits);

/// The whole table as pages.
std::vector<std::byte> encodeNodePages(const std::vector<Node>& nodes);

} // namespace pointfront
