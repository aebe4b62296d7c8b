#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/StoreWriter.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// A node of the tree under construction: its points are already encoded, or soon will be.
struct BuiltNode
{
  Node row; ///< box, spacing and counts; links and level come from nodeTable()
  int samplingQuarters = -1; ///< quarters of its SamplingDistance; -1 for a leaf
  StoreWriter::PayloadId payload = 0;
  std::vector<std::unique_ptr<BuiltNode>> children; ///< in the order of their octants
};

/// The smallest float that is not below.
float roundedUp(double v);

/// Sets centre, halfSize and radius from a node's own points and its finished children.
/// Rounding  outward, and a parent's box encloses its children's rounded boxes exactly.
void encloseNode(
  Node& row, const Bounds& own, const std::vector<std::unique_ptr<BuiltNode>>& children);

/// Sets centre, halfSize and radius so that they enclose `box`, which is not empty. Rounds outward.
void encloseBox(Node& row, const Bounds& box);

/// Node table and payloads in the order that StoreWriter::commit() wants.
struct NodeTable
{
  std::vector<Node> nodes; ///< breadth first, children neighbours in octant order
  std::vector<NodeIndex> roots;
  std::vector<StoreWriter::PayloadId> payloads;
  std::uint32_t levels = 0;
};

/// One tree a layer, null for a layer without points; none for an empty table. Makes spacing fall
/// strictly from parent to child.
NodeTable nodeTable(const std::vector<std::unique_ptr<BuiltNode>>& trees);

} // namespace pointfront
