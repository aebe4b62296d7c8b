#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodeTableSection.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Bytes of one page of a node table.
constexpr std::size_t nodePageBytes = 4096;

/// Rows in a page; the last page may have fewer. As many as fit, of either form.
constexpr std::uint32_t nodePageRowsOf(NodeRowForm form)
{
  return form == NodeRowForm::Plain ? 60 : 56;
}
/// Rows a page in tables that are written.
constexpr std::uint32_t nodePageRows = nodePageRowsOf(NodeRowForm::WithSplatRadius);

/// Room for a page of either form.
using NodePage = std::array<Node, nodePageRowsOf(NodeRowForm::Plain)>;

/// Pages of a table of so many nodes.
constexpr std::uint32_t nodePageCount(NodeIndex nodes, std::uint32_t pageRows = nodePageRows)
{
  return nodes / pageRows + (nodes % pageRows != 0 ? 1u : 0u);
}
/// Rows of one of them.
constexpr std::uint32_t nodePageLength(
  NodeIndex nodes, std::uint32_t page, std::uint32_t pageRows = nodePageRows)
{
  const NodeIndex left = nodes - page * pageRows;
  return left < pageRows ? left : pageRows;
}

/// The facts that every row must agree with, whatever other pages contain.
struct TableLimits
{
  NodeIndex nodes = 0;
  std::uint32_t layers = 1;
};

/// Appends page number `page`: rows, number of its first point, its number and a checksum. That
/// number is that of rows[0].firstPoint.
void encodeNodePage(const Node* rows, std::uint32_t count, std::uint32_t page, std::byte* target);

/// Fills the page's rows (those behind the last are left alone). What is wrong, or an empty text:
/// checksum, page number, and each row on its own (rowFault).
std::string decodeNodePage(const std::byte* data, std::uint32_t page, const TableLimits& limits,
  NodePage& rows, NodeRowForm form = NodeRowForm::WithSplatRadius);

/// The fault of a row by itself, or an empty text: sizes finite and not negative, parent
/// before it, children behind it and inside the table, layer and counts in range.
/// Walks up a table of such rows end, and walks down never leave it.
std::string rowFault(const Node& row, NodeIndex index, const TableLimits& limits);

/// The whole table as pages.
std::vector<std::byte> encodeNodePages(const std::vector<Node>& nodes);

} // namespace pointfront
