#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/StoreFormat.h"

#include <cstdint>
#include <memory>

namespace pointfront
{

/// The node table of a store. Of version 1 it is read as a whole, checked, and `stored` completed
/// with what it says (levels, layers' counts); since version 2 only the roots' pages are read here,
/// the others when they are touched.
Result<std::shared_ptr<const Hierarchy>> openNodeTable(
  const std::shared_ptr<const ByteSource>& file, std::uint32_t version, const StoreFooter& footer,
  StoredDescription& stored);

} // namespace pointfront
