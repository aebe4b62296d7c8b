#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Payload/BlockDirectory.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The second file of a store that refers to a store in the making (StoreWriter::createReferring).
struct PayloadElsewhere
{
  std::string storeName; ///< file name of the other store, in the folder of this one
  std::string nameMeanwhile; ///< the same file while it is written
  std::uint64_t bytes = 0; ///< that it had at least when this store was written
  /// By which it is known: positions of the node that was written last.
  BlockDirectory::Block mark;
};

/// The bytes of SectionKind::Elsewhere.
std::vector<std::byte> encodeElsewhere(const PayloadElsewhere& elsewhere);
/// Nothing if the bytes are no such section, or the name leaves the folder.
std::optional<PayloadElsewhere> decodeElsewhere(const std::byte* data, std::size_t size);

/// With the mark that `directory` gives.
PayloadElsewhere describeElsewhere(PayloadElsewhere elsewhere, const BlockDirectory& directory);

/// Opens the file that the store at `path` refers to: the one being written, or what has become of
/// it. Another file that has taken its name is told by the mark.
/// Errors  Truncated: it is gone, because its build was killed or cancelled.
Result<std::shared_ptr<const ByteSource>> openElsewhere(
  const std::string& path, const PayloadElsewhere& elsewhere);

} // namespace pointfront
