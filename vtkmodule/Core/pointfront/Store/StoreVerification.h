#pragma once

#include "pointfront/Store/GridBounds.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The sums over the points of some nodes.
struct SeenPoints
{
  GridBounds bounds;
  std::vector<ColumnRange> ranges;

  void add(const SeenPoints& other);
};

/// Walks the nodes of an open cloud and looks for the first thing that is wrong.
/// Source   docs/formats/pfront.md, section "What must hold".
/// Order    the fault reported is that of the lowest node that has one, for any number of threads.
/// Threads  run() is called from one thread and runs others, each on nodes of its own.
class StoreVerification
{
public:
  /// `gridBounds` is the box that the file claims for all points.
  StoreVerification(const StoredCloud& cloud, const GridBounds& gridBounds);

  /// Errors   Cancelled, NoMemory; what is wrong with the cloud is in the report.
  Result<VerifyReport> run(const ProgressFunction& progress);

private:
  struct Walk;
  SeenPoints nothingSeen() const;
  std::string tableFault() const;
  std::string readNodeRanges();
  std::string rangesFault(NodeIndex index, const Node& node) const;
  bool knownToHave(NodeIndex index, std::uint32_t component, const ValueRange& values) const;
  void work(Walk& walk) const;
  std::string nodeFault(NodeIndex index, SeenPoints& seen) const;
  std::string pointsFault(NodeIndex index, const NodeColumns& points, SeenPoints& seen) const;
  std::string sphereFault(NodeIndex index, const NodeColumns& points, const Bounds& box) const;
  std::string totalsFault(const SeenPoints& seen) const;

  const StoredCloud& cloud_;
  const StoreDescription& description_;
  const GridBounds& gridBounds_;
  const Hierarchy& hierarchy_;
  ColumnSelection everyColumn_;
  std::vector<std::shared_ptr<const NodeRanges>> nodeRanges_; ///< by component; empty: not stored
};

} // namespace pointfront
