#include "BytesAsFile.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/InPlace/SideFile.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace
{
constexpr std::size_t headerBytes = 64;

template <typename T>
void put(std::vector<std::byte>& bytes, std::size_t at, T value)
{
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Sizes and checksums that hold, so that what is behind them is reached: a fuzzer cannot guess
/// checksums.
void seal(std::vector<std::byte>& bytes)
{
  std::uint64_t offset = 0;
  std::memcpy(&offset, bytes.data() + 24, sizeof offset);
  offset = headerBytes + offset % (bytes.size() - headerBytes + 1);
  std::memcpy(bytes.data(), pointfront::sideFileMagic.data(), pointfront::sideFileMagic.size());
  put(bytes, 8, 1 + (std::to_integer<std::uint32_t>(bytes[8]) - 1) % pointfront::sideFileVersion);
  put(bytes, 12, std::uint32_t(0));
  put(bytes, 16, std::uint64_t(bytes.size()));
  put(bytes, 24, offset);
  put(bytes, 32, std::uint64_t(bytes.size() - offset));
  put(bytes, 40, pointfront::checksumOf(bytes.data() + offset, bytes.size() - offset));
  put(bytes, headerBytes - 4, pointfront::checksumOf(bytes.data(), headerBytes - 4));
}

void openAndRead(const std::vector<std::byte>& bytes)
{
  using namespace pointfront;
  const fuzz::BytesAsFile file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const Result<std::unique_ptr<const SideFile>> side = SideFile::open(file.path());
  if (!side)
  {
    fuzz::require(!side.error().what.empty(), "an Error says what happened");
    return;
  }
  const std::vector<Node>& nodes = (*side)->content().table.nodes;
  for (NodeIndex i = 0; i < nodes.size(); ++i)
  {
    if (nodes[i].pointCount > 1000000) // a list of no bytes claims as many for nothing
    {
      continue;
    }
    const Result<std::vector<std::uint64_t>> points = (*side)->pointsOf(i);
    fuzz::require(!points || points->size() == nodes[i].pointCount, "a node has its points");
    for (std::uint32_t held = 0; held < (*side)->content().held; ++held)
    {
      const Result<RawBytes> coded = (*side)->blockOf(i, held);
      const bool decoded = coded && (*side)->decodeBlock(i, held, *coded);
      static_cast<void>(decoded);
    }
  }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::vector<std::byte> bytes(size);
  std::transform(data, data + size, bytes.begin(), [](std::uint8_t b) { return std::byte(b); });
  openAndRead(bytes);
  if (size >= headerBytes)
  {
    seal(bytes);
    openAndRead(bytes);
  }
  pointfront::RunListReader list(bytes.data(), bytes.size());
  std::uint64_t end = 0;
  for (pointfront::Run run; list.next(run);)
  {
    pointfront::fuzz::require(run.first >= end && run.count > 0, "runs ascend");
    end = run.first + run.count;
  }
  return 0;
}
