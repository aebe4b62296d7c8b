#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

class ByteReader;
class ByteWriter;
struct StoreDescription;

/// The form of a table's rows: stores since version 3 and side files since version 2 say how large
/// splats are.
enum class NodeRowForm : std::uint8_t
{
  Plain,
  WithSplatRadius
};

/// Bytes of one node in a table, in pages (NodePage.h) or one after another.
constexpr std::size_t nodeRowBytes(NodeRowForm form)
{
  return form == NodeRowForm::Plain ? 68 : 72;
}

void encodeNodeRow(const Node& node, NodeRowForm form, ByteWriter& out);
Node decodeNodeRow(NodeRowForm form, ByteReader& in);

/// The node table as bytes, one row after another: side files, and stores of version 1.
std::vector<std::byte> encodeNodeTable(const std::vector<Node>& nodes, NodeRowForm form);

/// `data` must have nodeCount rows (the caller has checked it against the file).
std::vector<Node> decodeNodeTable(const std::byte* data, std::uint32_t nodeCount, NodeRowForm form);

/// A table whose rows somebody else holds, for the length of a check.
class BorrowedTable final : public Hierarchy
{
public:
  BorrowedTable(const std::vector<Node>& nodes, Refinement refinement);
  NodeIndex nodeCount() const override { return static_cast<NodeIndex>(nodes_.size()); }
  Node node(NodeIndex index) const override { return nodes_[index]; }
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return refinement_; }

private:
  const std::vector<Node>& nodes_;
  std::vector<NodeIndex> roots_;
  Refinement refinement_;
};

/// The fault of a table, or an empty text: parents before children, children neighbours and
/// linked both ways, levels, layers, counts and their sums (of points of the input), sizes finite
/// and not negative, roots those without a parent; or what a paged table itself calls its fault.
/// Time  linear in the nodes, from the first to the last; takes no memory.
std::string nodeTableFault(
  const Hierarchy& table, std::size_t layerCount, std::uint64_t pointCount);
std::string nodeTableFault(const std::vector<Node>& nodes, std::size_t layerCount,
  std::uint64_t pointCount, Refinement refinement = Refinement::Add);

/// Sets the layers' counts and the number of levels to those of the table.
void countLayers(const Hierarchy& table, StoreDescription& description);

/// Nodes without a parent, in the table's order.
std::vector<NodeIndex> rootsOf(const std::vector<Node>& nodes);

} // namespace pointfront
