#pragma once

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/NodeRangesSection.h"
#include "pointfront/Store/PayloadDirectory.h"
#include "pointfront/Store/PayloadElsewhere.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreFormat.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace pointfront
{

/// All of an open store but its points; constant once open() has returned.
struct PointStore::Content
{
  std::shared_ptr<const ByteSource> file; ///< the hierarchy has a part in it
  StoreDescription description;
  GridBounds gridBounds;
  std::shared_ptr<const Hierarchy> hierarchy;
  std::unique_ptr<const PayloadDirectory> directory; ///< reads from `file`
  std::optional<NodeRangesFile> ranges;
  bool isCollection = false; ///< the points are heads of tiles
  std::optional<PayloadElsewhere> elsewhere;
  std::shared_ptr<const ByteSource> fileElsewhere; ///< with `elsewhere`, unless only looked at

  const ByteSource& fileOf(const BlockDirectory::Block& block) const
  {
    return block.elsewhere ? *fileElsewhere : *file;
  }
};

/// The node table of a store. Of version 1 it is read as a whole, checked, and `stored` completed
/// with what it says (levels, layers' counts); since version 2 only the roots' pages are read here,
/// the others when they are touched.
Result<std::shared_ptr<const Hierarchy>> openNodeTable(
  const std::shared_ptr<const ByteSource>& file, std::uint32_t version, const StoreFooter& footer,
  StoredDescription& stored);

} // namespace pointfront
