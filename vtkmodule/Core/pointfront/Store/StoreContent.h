#pragma once

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/NodeRangesSection.h"
#include "pointfront/Store/PayloadDirectory.h"
#include "pointfront/Store/PayloadElsewhere.h"
#include "pointfront/Store/PointStore.h"

#include <memory>
#include <optional>
#include <string>

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
  std::optional<PayloadElsewhere> elsewhere;
  std::unique_ptr<const ByteSource> fileElsewhere; ///< with `elsewhere`, unless only looked at

  const ByteSource& fileOf(const NodePayload& payload) const
  {
    return payload.elsewhere ? *fileElsewhere : *file;
  }
};

/// "node 12, positions" or "node 12, attribute 'rgb'", for messages.
std::string blockName(const StoreDescription& description, NodeIndex node, std::uint32_t block);

} // namespace pointfront
