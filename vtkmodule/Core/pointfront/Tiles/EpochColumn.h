#pragma once

#include "pointfront/Disk/Epoch.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/CollectionTable.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// The column of a collection that tells the epoch of each point, as its time (timesOf() all
/// epochs). No file has it: all points of a node are of one epoch, because each epoch has trees of
/// its own, so that the column costs nothing until a node is decoded for somebody who names it.
/// Name     `epoch`; `epoch_of_tile` where the tiles have an attribute of that name.
/// Threads  const functions from any thread.
class EpochColumn
{
public:
  /// Nothing: no tile names its epoch, or an older version put several epochs into one tree.
  static std::optional<EpochColumn> of(
    std::shared_ptr<const CollectionTable> table, const CollectionRecord& record);

  /// Adds the column behind all others, and the times of the description's epochs.
  void describe(StoreDescription& cloud);
  bool isIn(const ColumnSelection& columns) const
  {
    return !columns.empty() && columns.back() == column_; // ascending, and it is the last
  }
  /// The columns that tiles have.
  ColumnSelection others(const ColumnSelection& columns) const
  {
    return ColumnSelection(columns.begin(), columns.end() - (isIn(columns) ? 1 : 0));
  }
  /// Adds the column to a node that was read with others(columns).
  void fill(NodeColumns& node) const;
  /// Time of the epoch of a node's points, and of all below it.
  double timeOf(NodeIndex node) const;

private:
  EpochColumn() = default;

  std::shared_ptr<const CollectionTable> table_;
  std::vector<EpochTime> epochs_;
  std::vector<double> ofHeads_; ///< by node of the tree of heads
  std::vector<double> ofTiles_; ///< by tile
  std::uint32_t column_ = 0;
};

} // namespace pointfront
