#pragma once

#include "pointfront/Front/NodePruning.h"
#include "pointfront/Query/NodeSweep.h"
#include "pointfront/Query/PointQuery.h"
#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/PointFilter.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// A query against one stored cloud: which nodes have to be read, and what is chosen of each.
/// Nodes      ascending; those whose bounds lie outside of a region, or whose stored ranges exclude
///            all their points, are not among them.
/// Size       12 bytes a node.
/// Threads    a value; const functions from any thread.
class QueryPlan
{
public:
  /// Errors  BadArgument: an attribute that the cloud has not, classes of a cloud without
  ///         `classification`, a spacing that is negative or NaN; damage of the node table.
  /// Cost    some ns a node; may wait for the disk.
  static Result<QueryPlan> make(const StoredCloud& store, const PointQuery& query);
  /// The same without stored ranges.
  static Result<QueryPlan> make(
    const StoreDescription& store, const Hierarchy& hierarchy, const PointQuery& query);

  /// The description of the cloud with the requested attributes only.
  const StoreDescription& description() const { return description_; }
  /// Schema of the batches.
  const AttributeSchema& schema() const { return description_.schema; }

  std::size_t nodeCount() const { return nodes_.size(); }
  NodeIndex node(std::size_t i) const { return nodes_[i].node; }
  std::uint32_t nodePoints(std::size_t i) const { return nodes_[i].points; }
  /// Points of these nodes: no more can be chosen.
  std::uint64_t mostPoints() const;

  /// A share of the nodes for one of several ranks: neighbours in the list. All shares have about
  /// as many points, and together they are the plan.
  QueryPlan piece(unsigned piece, unsigned pieces) const;

  /// Reads the nodes and hands over what is chosen; see sweepNodes() for order, memory, errors.
  Result<QueryReport> run(
    const NodeReader& reader, const QueryOptions& options, const QueryConsumer& consume) const;
  /// Most memory that one of the nodes needs alone: a smaller budget is NoMemory.
  std::size_t leastMemoryBytes(const NodeReader& reader) const;

private:
  struct PlannedNode
  {
    NodeIndex node;
    std::uint32_t points;
    bool tested; ///< against the regions: it is not inside all of them
  };

  QueryPlan() = default;
  /// All but the nodes.
  static Result<QueryPlan> makeWithoutNodes(
    const StoreDescription& store, const Hierarchy& hierarchy, const PointQuery& query);
  Result<void> chooseConditions(
    const StoreDescription& store, const Hierarchy& hierarchy, const PointQuery& query);
  Result<void> chooseColumns(const StoreDescription& store, const PointQuery& query);
  Result<void> chooseNodes(const Hierarchy& hierarchy, double spacing, const NodePruning* pruning);
  Overlap overlap(const Bounds& box) const;
  QueryBatch choose(std::size_t task, NodeColumns&& node) const;
  /// Numbers of the points that pass; none if all do.
  std::optional<std::vector<std::uint32_t>> passing(
    const NodeColumns& node, const std::vector<glm::dvec3>& positions, bool tested) const;
  NodeSweep sweep() const;

  StoreDescription description_;
  AttributeSchema storeSchema_;
  QuantisationGrid grid_;
  std::vector<std::shared_ptr<const Region>> regions_;
  PointFilter filter_; ///< classes too
  ColumnSelection read_; ///< columns of the store
  std::vector<std::size_t> out_; ///< place in read_ of each column that comes out
  std::vector<PlannedNode> nodes_;
};

/// Plan and run in one.
Result<QueryReport> queryPoints(const StoredCloud& store, const PointQuery& query,
  const QueryOptions& options, const QueryConsumer& consume);

} // namespace pointfront
