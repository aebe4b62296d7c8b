#include "BytesAsFile.h"

#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreFormat.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace
{
using namespace pointfront;

/// A store of these bytes: opened, checked and, whatever the check says, read node by node.
void openAndRead(const std::vector<std::byte>& bytes)
{
  const fuzz::BytesAsFile file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const Result<std::shared_ptr<const PointStore>> opened = PointStore::open(file.path());
  if (!opened)
  {
    fuzz::require(!opened.error().what.empty(), "an Error says what happened");
    return;
  }
  const PointStore& store = **opened;
  if (const Result<VerifyReport> verified = store.verify(); !verified)
  {
    fuzz::require(!verified.error().what.empty(), "an Error says what happened");
  }
  ColumnSelection columns(store.description().schema.size());
  for (std::uint32_t column = 0; column < columns.size(); ++column)
  {
    columns[column] = column;
  }
  for (NodeIndex node = 0; node < store.hierarchy()->nodeCount(); ++node)
  {
    const std::uint32_t count = store.hierarchy()->node(node).pointCount;
    if (store.decodedBytes(node, count, columns) > (std::size_t(1) << 28)) // columns without bytes
    {
      continue;
    }
    const Result<NodeColumns> points = store.read(node, columns);
    fuzz::require(!points || points->size() == store.hierarchy()->node(node).pointCount,
      "a node has its points");
  }
}

/// The sizes that the header names are made those of the bytes, so that what is behind it is
/// reached when bytes were added or taken away.
void fitHeader(std::vector<std::byte>& bytes)
{
  constexpr std::size_t fileBytesAt = 16;
  constexpr std::size_t footerOffsetAt = 24;
  constexpr std::size_t footerBytesAt = 32;
  const std::uint64_t size = bytes.size();
  std::uint32_t footerBytes = 0;
  std::memcpy(&footerBytes, bytes.data() + footerBytesAt, sizeof footerBytes);
  const std::uint64_t footerOffset = size - std::min<std::uint64_t>(footerBytes, size);
  std::memcpy(bytes.data(), storeMagic.data(), storeMagic.size());
  std::memcpy(bytes.data() + fileBytesAt, &size, sizeof size);
  std::memcpy(bytes.data() + footerOffsetAt, &footerOffset, sizeof footerOffset);
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::vector<std::byte> bytes(size);
  std::transform(data, data + size, bytes.begin(), [](std::uint8_t b) { return std::byte(b); });
  openAndRead(bytes);
  if (size >= storeHeaderBytes)
  {
    fitHeader(bytes);
    openAndRead(bytes);
  }
  return 0;
}
