#include "BytesAsFile.h"

#include "pointfront/Tiles/CollectionCloud.h"

#include <algorithm>
#include <vector>

namespace
{
using namespace pointfront;

/// A collection of these bytes: opened, and its heads walked and read; its tiles are not there.
void openAndWalk(const fuzz::BytesAsFile& file)
{
  const auto opened = CollectionCloud::open(file.path());
  if (!opened)
  {
    fuzz::require(!opened.error().what.empty(), "an Error says what happened");
    return;
  }
  const CollectionCloud& cloud = **opened;
  const Hierarchy& table = *cloud.hierarchy();
  for (NodeIndex node = 0; node < cloud.record().heads.size(); ++node)
  {
    const Node row = table.node(node);
    fuzz::require(row.parent == noNode || row.parent < node, "parents come first");
    if (row.pointCount < 1u << 16)
    {
      const Result<NodeColumns> points = cloud.read(node, {});
      fuzz::require(!points || points->size() == row.pointCount, "a node has its points");
    }
  }
  static_cast<void>(cloud.nodeRanges(0));
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  openAndWalk(fuzz::BytesAsFile(data, size));
  std::vector<std::byte> bytes(size);
  std::transform(data, data + size, bytes.begin(), [](std::uint8_t b) { return std::byte(b); });
  if (const auto record = CollectionRecord::decode(bytes.data(), bytes.size());
      record && record->version == CollectionRecord::newest)
  {
    const std::vector<std::byte> again = record->encode();
    fuzz::require(CollectionRecord::decode(again.data(), again.size()).has_value(),
      "a record that was read is written and read again");
  }
  return 0;
}
