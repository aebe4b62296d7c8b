#pragma once

#include "pointfront/Plan/FramePlanner.h"

#include <atomic>
#include <memory>
#include <vector>

namespace pointfront::test
{

constexpr std::uint32_t pointsOfPlannedNode = 1000;

//   layer 0        layer 1        layer 2
//      0              1              2       spacing 8
//    3   4            5                      spacing 4
inline std::vector<Node> rowsOfLayers()
{
  std::vector<Node> rows(6);
  for (NodeIndex n = 0; n < 6; ++n)
  {
    Node& row = rows[n];
    row.centre = { n < 3 ? 0.0 : (n == 4 ? 50.0 : -50.0), 0.0, 0.0 };
    row.halfSize = glm::vec3(n < 3 ? 100.0f : 50.0f);
    row.radius = n < 3 ? 180.0f : 90.0f;
    row.spacing = n < 3 ? 8.0f : 4.0f;
    row.pointCount = pointsOfPlannedNode;
    row.pointsBelow = n == 0 ? 3000 : n == 1 ? 2000 : 1000;
    row.parent = n < 3 ? noNode : n < 5 ? 0 : 1;
    row.level = n < 3 ? 0 : 1;
    row.layer = std::uint16_t(n < 3 ? n : row.parent);
  }
  rows[0].firstChild = 3;
  rows[0].childCount = 2;
  rows[1].firstChild = 5;
  rows[1].childCount = 1;
  return rows;
}

class LayeredReader final : public NodeReader
{
public:
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    ++reads;
    NodeColumns node;
    node.node = fetched.node;
    const Node row = table->node(fetched.node);
    node.describe(row);
    node.origin =
      QuantisationGrid{ glm::dvec3(0.01) }.toGrid(row.centre - glm::dvec3(row.halfSize) + ownLow);
    node.positions.resize(pointsOfPlannedNode);
    node.selection = fetched.columns;
    node.columns.resize(fetched.columns.size(), std::vector<std::byte>(pointsOfPlannedNode));
    return node;
  }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection& columns) const override
  {
    return sizeof(NodeColumns) + pointsOfPlannedNode * (sizeof(glm::u32vec3) + columns.size()) +
      columns.size() * sizeof(std::vector<std::byte>);
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 1; }

  glm::dvec3 ownLow{ 0.0 }; ///< the lowest of a node's own points, from the low of its box
  mutable std::atomic<int> reads{ 0 };
  std::shared_ptr<const Hierarchy> table = std::make_shared<HierarchyTable>(
    rowsOfLayers(), std::vector<NodeIndex>{ 0, 1, 2 }, Refinement::Add);
};

inline std::shared_ptr<const ResolvedStyle> flatStyle()
{
  return std::make_shared<const ResolvedStyle>();
}

inline std::shared_ptr<const ResolvedStyle> styleOfSize(SplatSize::Mode mode)
{
  ResolvedStyle style;
  style.size.mode = mode;
  return std::make_shared<const ResolvedStyle>(style);
}

/// A front of six nodes in three layers, and what a plan of it needs.
struct PlannerScene
{
  PlannerScene()
  {
    description.schema = schema;
    description.splatRadiusBase = 0.25;
    description.grid.scale = glm::dvec3(0.01);
    frameRequest.view =
      View::perspective({ 0, 0, 1000 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.9, 1.0, 1e5, 1000, 1000);
    request.camera =
      FrameCamera::perspective({ 0, 0, 1000 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.9, 1.0, 1e5, 1000, 1000);
    frameRequest.complete = true;
    request.styles = { flatStyle(), flatStyle(), flatStyle() };
  }
  static AttributeSchema oneColumn()
  {
    AttributeSchema schema;
    Attribute value;
    value.name = "value";
    value.type = ScalarType::UInt8;
    schema.add(value);
    return schema;
  }
  FramePlan plan(double errorPx)
  {
    frameRequest.targetErrorPx = errorPx;
    front.update(frameRequest);
    return planFrame(front, description, request);
  }

  AttributeSchema schema = oneColumn();
  std::shared_ptr<LayeredReader> reader = std::make_shared<LayeredReader>();
  ResidencyShare share{ reader, 6, ResidencyOptions() };
  ViewFront front{ std::make_shared<HierarchyPiece>(reader->table, 0, 1), share, schema,
    std::make_shared<WindowDemand>() };
  StoreDescription description;
  FrameRequest frameRequest;
  PlanRequest request;
};

} // namespace pointfront::test
