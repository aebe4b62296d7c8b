#pragma once

#include "pointfront/Collection/CollectionWriter.h"
#include "pointfront/Collection/HeadTree.h"
#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Store/HeldColours.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreWriter.h"
#include "pointfront/Tiles/CollectionRecord.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace pointfront
{

/// The next state of a collection while it is put together.
/// Threads  one thread; it runs others.
class CollectionState
{
public:
  /// `before` is the heads' store of the state before, `record` its record; null: there is none.
  CollectionState(std::string path, std::shared_ptr<const PointStore> before,
    std::optional<CollectionRecord> record);

  /// The record of the next state; its tiles come with change().
  CollectionRecord& record() { return next_; }
  /// Takes some tiles out and others in; sets ids of those that have none.
  Result<void> change(const std::unordered_set<std::uint32_t>& removed,
    std::vector<IncomingTile> added, const CollectionOptions& options);
  /// Writes it and gives it its name.
  Result<CollectionReport> write(std::unique_ptr<OutputFile> file);

private:
  void takeTiles(std::vector<IncomingTile>& added, const CollectionOptions& options);
  Result<std::vector<TileDescription::Part>> describe(std::size_t added);
  Result<void> chooseAdaption();
  Result<void> openTrees();
  void renameTrees();
  std::unique_ptr<HeadItem> storedItem(NodeIndex node) const;
  Result<HeadPoints> load(const HeadItem& group) const;
  Result<void> insertHeads(const std::vector<IncomingTile>& added,
    const std::vector<TileDescription::Part>& parts, const CollectionOptions& options);
  AttributeSchema headsSchema() const;

  std::string path_;
  std::shared_ptr<const PointStore> before_;
  std::optional<CollectionRecord> last_; ///< without tiles and history from change() on
  CollectionRecord next_;
  HeldColours lastColours_ = HeldColours::None; ///< in the whole of the state before
  bool recoded_ = false; ///< stored points are not as the next state has them
  std::unique_ptr<TileDescription> adaption_; ///< part 1: of the whole of the state before
  std::map<HeadTreeKey, HeadTree> trees_;
};

} // namespace pointfront
