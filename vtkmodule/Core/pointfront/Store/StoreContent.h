#pragma once

#include "pointfront/Store/BlockDirectory.h"
#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/InputFile.h"
#include "pointfront/Store/PointStore.h"

#include <memory>
#include <string>

namespace pointfront
{

/// All of an open store but its points; constant once open() has returned.
struct PointStore::Content
{
  std::unique_ptr<const InputFile> file;
  StoreDescription description;
  GridBounds gridBounds;
  std::shared_ptr<const Hierarchy> hierarchy;
  BlockDirectory directory{ 1 };
};

/// "node 12, positions" or "node 12, attribute 'rgb'", for messages.
std::string blockName(const StoreDescription& description, NodeIndex node, std::uint32_t block);

/// What the points of some nodes add up to.
struct SeenPoints
{
  GridBounds bounds;
  std::vector<ColumnRange> ranges;

  void add(const SeenPoints& other);
};

/// Walks an open store and looks for the first thing that is wrong.
/// Source   docs/formats/pfront.md, section "What must hold".
/// Order    the fault reported is that of the lowest node that has one, for any number of threads.
/// Threads  run() is called from one thread and runs others, each on nodes of its own.
class StoreVerification
{
public:
  StoreVerification(
    const PointStore& store, const StoreDescription& description, const GridBounds& gridBounds);

  /// Cancelled is the only Error.
  Result<VerifyReport> run(const ProgressFunction& progress);

private:
  struct Walk;
  SeenPoints nothingSeen() const;
  void work(Walk& walk) const;
  std::string nodeFault(NodeIndex index, SeenPoints& seen) const;
  std::string pointsFault(NodeIndex index, const NodeColumns& points, SeenPoints& seen) const;
  std::string sphereFault(NodeIndex index, const NodeColumns& points, const Bounds& box) const;
  std::string totalsFault(const SeenPoints& seen) const;

  const PointStore& store_;
  const StoreDescription& description_;
  const GridBounds& gridBounds_;
  const Hierarchy& hierarchy_;
  ColumnSelection everyColumn_;
};

} // namespace pointfront
